#include "sim/gate/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/gate/outcomes_fixture.h"

namespace dodgesim {
namespace {

using testing::csv_of;
using ::testing::HasSubstr;
using testing::quiet_flight_that;
using testing::table_of;
using testing::throw_that;

Comparison compared(const std::string& first, const std::string& second) {
  return compare(outcomes(table_of(first)), outcomes(table_of(second)));
}

TEST(Outcomes, say_what_became_of_a_throw) {
  const auto all = outcomes(table_of("dhcem"));
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[0].what, "dodged");
  EXPECT_EQ(all[1].what, "hit");
  EXPECT_EQ(all[2].what, "crashed");
  EXPECT_EQ(all[3].what, "error: killed, \"by\" signal 9");
  for (const ThrowOutcome& t : all) {
    EXPECT_EQ(t.success, t.number == 0 || t.number == 4) << t.number;
    EXPECT_EQ(t.counts, t.number != 4) << "a throw that would have missed counts for nothing";
  }
  EXPECT_EQ(all[1].label, "0.2 m ball, 5.01 m/s from 3 m");
}

TEST(Outcomes, of_quiet_flights_fail_by_evading) {
  const CsvTable table(csv_of({quiet_flight_that(0, false), quiet_flight_that(1, true)}), "t");
  const auto all = outcomes(table);
  EXPECT_TRUE(all[0].counts && all[0].success);
  EXPECT_TRUE(all[1].counts && !all[1].success);
}

TEST(Comparison, pairs_equal_throws) {
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

TEST(Comparison, leaves_out_what_would_have_hit_in_one_campaign_only) {
  const Comparison c = compared("ddm", "dmd");
  EXPECT_EQ(c.counts.total(), 1);
  EXPECT_EQ(c.counts_differ, 2);
  EXPECT_THAT(comparison_text(c, "a", "b"), HasSubstr("2 throws would have hit in one campaign"));
}

TEST(Comparison, takes_the_common_part_of_campaigns_of_different_length) {
  const Comparison c = compared("dddd", "dh");
  EXPECT_TRUE(c.paired);
  EXPECT_EQ(c.throws, 2);
  EXPECT_EQ(c.counts.only_first, 1);
}

TEST(Comparison, of_different_throws_is_unpaired) {
  ThrowResult other = throw_that(0, 'd');
  other.bearing_deg = 10;
  const Comparison c = compare(outcomes(table_of("dh")),
                               outcomes(CsvTable(csv_of({other, throw_that(1, 'h')}), "t")));
  EXPECT_FALSE(c.paired);
  EXPECT_EQ(c.second.successes, 1);
  EXPECT_EQ(c.second.trials, 2);
  EXPECT_THAT(comparison_text(c, "a", "b"), HasSubstr("of different throws"));
}

TEST(Comparison, mirrors_when_the_campaigns_are_exchanged) {
  const Comparison ab = compared("ddhhdcd", "dhhdddh"), ba = compared("dhhdddh", "ddhhdcd");
  EXPECT_EQ(ab.lost.size(), ba.gained.size());
  EXPECT_EQ(ab.gained.size(), ba.lost.size());
  EXPECT_EQ(ab.first.successes, ba.second.successes);
}

// McNemar's exact test with 5 lost and none gained: 2 / 2^5.
TEST(Comparison, states_rates_difference_and_p_value) {
  const std::string text = comparison_text(compared("dddddd", "dhhhhh"), "before", "after");
  EXPECT_THAT(text, HasSubstr("before: 6 of 6 succeeded (1.000, "));
  EXPECT_THAT(text, HasSubstr("after: 1 of 6 succeeded (0.167, "));
  EXPECT_THAT(text, HasSubstr("Difference: -0.833"));
  EXPECT_THAT(text, HasSubstr("p = 0.0625, of the same throws: 5 lost, 0 gained"));
}

}  // namespace
}  // namespace dodgesim
