#include "sim/gate/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/sim/gate/outcomes_fixture.h"

namespace dodgesim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
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

TEST(Comparison, LeavesOutWhatWouldHaveHitInOneCampaignOnly) {
  const Comparison c = compared("ddm", "dmd");
  EXPECT_EQ(c.counts.total(), 1);
  EXPECT_THAT(c.counts_differ, ElementsAre(1, 2));
  EXPECT_THAT(comparison_text(c, "a", "b"),
              HasSubstr("Left out, because they would have hit in one campaign only: throws 1, 2"));
}

TEST(Comparison, TakesTheCommonPartOfCampaignsOfDifferentLength) {
  const Comparison c = compared("dddd", "dh");
  EXPECT_TRUE(c.paired);
  EXPECT_EQ(c.throws, 2);
  EXPECT_EQ(c.counts.only_first, 1);
  EXPECT_THAT(c.unmatched, ElementsAre(2, 3));
  EXPECT_THAT(compared("dh", "dddd").unmatched, ElementsAre(2, 3));
  EXPECT_THAT(comparison_text(c, "a", "b"),
              HasSubstr("Left out, because only one campaign has them: throws 2, 3\n"));
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

}  // namespace
}  // namespace dodgesim
