#include "sim/gate/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/sim/gate/outcomes_fixture.h"

namespace dodgesim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::tables_of;
using testing::throw_that;

Comparison compared(const std::string& first, const std::string& second) {
  return compare(outcomes(tables_of(first)), outcomes(tables_of(second)));
}

TEST(Comparison, PairsEqualThrows) {
  const Comparison c = compared("ddddhhhm", "dddhdhhm");
  EXPECT_TRUE(c.paired);
  EXPECT_EQ(c.counts.both, 3);
  EXPECT_EQ(c.counts.only_first, 1);
  EXPECT_EQ(c.counts.only_second, 1);
  EXPECT_EQ(c.counts.neither, 2);
  ASSERT_EQ(c.lost.size(), 1U);
  EXPECT_EQ(c.lost[0].number, 3);
  EXPECT_EQ(c.lost[0].before, "dodged");
  EXPECT_EQ(c.lost[0].after, "hit");
  ASSERT_EQ(c.gained.size(), 1U);
  EXPECT_EQ(c.gained[0].number, 4);
  EXPECT_EQ(c.first.trials, 7);
}

TEST(Comparison, IsOfTheSameGridAndSweep) {
  auto first = outcomes(tables_of("dd")), second = first;
  first[1].cell = second[1].cell = 1;
  first[1].settings = second[1].settings = {{"oracle.range_cap_m", "0.8"}};
  expect_same_settings(first, second, "a", "b");
  second[1].settings[0].value = "1.5";
  try {
    expect_same_settings(first, second, "a", "b");
    FAIL() << "compared different experiments";
  } catch (const ScenarioError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("a has oracle.range_cap_m 0.8 where b has oracle.range_cap_m 1.5;"));
  }
  second[1].cell = 2;  // nothing that both have
  expect_same_settings(first, second, "a", "b");
}

TEST(Comparison, OfDifferentThrowsIsOfTheSameCells) {
  auto first = outcomes(tables_of("dhdh")), second = outcomes(tables_of("dhd"));
  for (ThrowOutcome& t : first) t.cell = t.number % 2;
  for (ThrowOutcome& t : second) t.cell = t.number % 3;
  second[2].settings = {{"throw.speed_mps", "10"}};
  expect_same_cells(first, first, "a", "b");
  for (const bool swapped : {false, true}) {
    try {
      expect_same_cells(swapped ? second : first, swapped ? first : second, swapped ? "b" : "a",
                        swapped ? "a" : "b");
      FAIL() << "compared rates of different cells";
    } catch (const ScenarioError& error) {
      EXPECT_THAT(error.what(), HasSubstr("b has throws of throw.speed_mps 10, a has none;"));
    }
  }
}

TEST(Comparison, LeavesOutWhatWouldHaveHitInOneCampaignOnly) {
  const Comparison c = compared("ddm", "dmd");
  EXPECT_EQ(c.counts.total(), 1);
  EXPECT_THAT(c.counts_differ, ElementsAre(1, 2));
  EXPECT_THAT(
      comparison_text(c, "a", "b"),
      HasSubstr(
          "Left out, because in one of the two they would have missed, or nobody could fly them: "
          "throws 1, 2"));
}

TEST(Comparison, LeavesOutWhatNobodyCouldFlyInOneCampaign) {
  std::vector<ThrowOutcome> first = outcomes(tables_of("ddd")), second = first;
  second[1].nobody_could_fly = true;
  second[1].counts = false;
  const Comparison c = compare(first, second);
  EXPECT_TRUE(c.paired);
  EXPECT_EQ(c.counts.total(), 2);
  EXPECT_THAT(c.counts_differ, ElementsAre(1));
  EXPECT_THAT(comparison_text(c, "a", "b"), HasSubstr("or nobody could fly them: throws 1\n"));
}

TEST(Comparison, TakesTheCommonPartOfCampaignsOfDifferentLength) {
  const Comparison c = compared("dddd", "dh");
  EXPECT_TRUE(c.paired);
  EXPECT_EQ(c.throws, 2);
  EXPECT_EQ(c.counts.only_first, 1);
  EXPECT_THAT(c.only_first, ElementsAre(2, 3));
  EXPECT_THAT(compared("dh", "dddd").only_second, ElementsAre(2, 3));
  EXPECT_THAT(comparison_text(c, "a", "b"),
              HasSubstr("Left out, because only a has them: throws 2, 3\n"));
}

// As sweeps of two values with so many throws each: those of value 1 are numbered from there.
std::vector<ThrowOutcome> swept(const std::string& value_0, const std::string& value_1) {
  std::vector<ThrowResult> results;
  for (std::size_t i = 0; i < value_0.size() + value_1.size(); ++i) {
    const bool second = i >= value_0.size();
    const std::size_t stream = second ? i - value_0.size() : i;
    results.push_back(throw_that(static_cast<int>(stream), (second ? value_1 : value_0)[stream]));
    results.back().index = static_cast<int>(i);
    results.back().sweep = second ? 1 : 0;
  }
  CampaignTables tables = tables_of(results);
  tables.seed = 3;
  return outcomes(tables);
}

TEST(Comparison, PairsTheThrowsOfASweepWhateverTheRepeats) {
  const Comparison c = compare(swept("dd", "dh"), swept("ddh", "hhd"));
  EXPECT_TRUE(c.paired);
  EXPECT_EQ(c.throws, 4);
  EXPECT_THAT(c.differing, ::testing::IsEmpty());
  EXPECT_THAT(c.only_second, ElementsAre(2, 5));
  ASSERT_EQ(c.lost.size(), 1U);
  EXPECT_EQ(c.lost[0].number, 2);
  EXPECT_EQ(c.lost[0].number_after, 3);
}

TEST(Comparison, DoesNotPairThrowsOfDifferentCells) {
  auto first = swept("dddd", ""), second = first;
  for (ThrowOutcome& t : first) t.cell = t.number % 2;
  for (ThrowOutcome& t : second) t.cell = t.number % 3;
  EXPECT_FALSE(compare(first, second).paired);
  EXPECT_TRUE(compare(first, first).paired);
}

TEST(Comparison, PairsThrowsOfOneSeedThatWereDrawnOtherwise) {
  auto first = swept("dddddd", ""), second = swept("dhhhhh", "");
  for (ThrowOutcome& t : second) t.draw[0].numbers[1] += 0.5;
  const Comparison c = compare(first, second);
  EXPECT_TRUE(c.paired);
  EXPECT_THAT(c.differing, ElementsAre("speed_mps"));
  EXPECT_THAT(comparison_text(c, "a", "b"),
              HasSubstr("p = 0.0625, of throws with the same random numbers (speed_mps differs): "
                        "5 lost, 0 gained (McNemar's test"));
  for (ThrowOutcome& t : second) t.seed = 4;
  EXPECT_FALSE(compare(first, second).paired);
  for (ThrowOutcome& t : second) t.seed.reset();
  EXPECT_FALSE(compare(first, second).paired) << "nothing says that the numbers are the same";
}

TEST(Comparison, OfDifferentThrowsIsUnpaired) {
  ThrowResult other = throw_that(0, 'd');
  other.bearing_deg = 10;
  const Comparison c =
      compare(outcomes(tables_of("dh")), outcomes(tables_of({other, throw_that(1, 'h')})));
  EXPECT_FALSE(c.paired);
  EXPECT_EQ(c.second.successes, 1);
  EXPECT_EQ(c.second.trials, 2);
  EXPECT_THAT(comparison_text(c, "a", "b"), HasSubstr("of different throws"));
}

TEST(Comparison, MirrorsWhenTheCampaignsAreExchanged) {
  const Comparison ab = compared("ddhhdcd", "dhhdddh"), ba = compared("dhhdddh", "ddhhdcd");
  EXPECT_EQ(ab.lost.size(), ba.gained.size());
  EXPECT_EQ(ab.gained.size(), ba.lost.size());
  EXPECT_EQ(ab.first.successes, ba.second.successes);
}

// McNemar's exact test with 5 lost and none gained: 2 / 2^5.
TEST(Comparison, StatesRatesDifferenceAndPValue) {
  const std::string text = comparison_text(compared("dddddd", "dhhhhh"), "before", "after");
  EXPECT_THAT(text, HasSubstr("before: 6 of 6 succeeded (1.000, "));
  EXPECT_THAT(text, HasSubstr("after: 1 of 6 succeeded (0.167, "));
  EXPECT_THAT(text, HasSubstr("Difference: -0.833"));
  EXPECT_THAT(text, HasSubstr("p = 0.0625, of the same throws: 5 lost, 0 gained"));
}

TEST(Comparison, StatesNoRateWhereNoThrowCounts) {
  Comparison of_misses = compared("mm", "mm");
  for (const bool paired : {true, false}) {
    of_misses.paired = paired;
    const std::string text = comparison_text(of_misses, "before", "after");
    EXPECT_THAT(text, HasSubstr("before: 0 of 0 succeeded\nafter: 0 of 0 succeeded\n"));
    EXPECT_THAT(text, HasSubstr(paired ? "and would have hit in both\n" : "one of the two has no"));
    EXPECT_THAT(text, Not(HasSubstr("p =")));
  }
  EXPECT_THAT(comparison_text(compared("mh", "hm"), "before", "after"),
              HasSubstr("would have hit in both\nLeft out, because in one of the two they"));
}

}  // namespace
}  // namespace dodgesim
