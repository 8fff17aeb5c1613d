#include "sim/tables/early_stop.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "tests/sim/tables/stopping.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

TEST(EarlyStop, ComesWithTheThrowAtWhichTheRuleIsMet) {
  EarlyStop stop(stopping(0.1, 1000));
  const FixedWidthRule rule(0.1, 0.95, 1000);
  int dodged = 0, trials = 0, expected = 0;
  while (!rule.done(dodged, trials)) {
    trials += expected % 10 != 0 ? 1 : 0;
    dodged += expected % 10 != 0 && expected % 5 != 1 ? 1 : 0;
    ++expected;
  }
  for (int i = 0; i < 1000; ++i) stop.add(nth_throw(i));
  EXPECT_EQ(stop.end(), expected);
  EXPECT_THAT(stop.text(),
              HasSubstr("Ended by stop after " + std::to_string(expected) +
                        " throws: " + std::to_string(dodged) + " of " + std::to_string(trials)));
}

TEST(EarlyStop, DoesNotDependOnTheOrderInWhichThrowsFinish) {
  EarlyStop in_order(stopping(0.1, 1000));
  for (int i = 0; i < 1000; ++i) in_order.add(nth_throw(i));
  std::vector<int> order(1000);
  for (int i = 0; i < 1000; ++i) order[static_cast<std::size_t>(i)] = i;
  std::mt19937 random(1);
  for (int run = 0; run < 5; ++run) {
    for (auto first = order.begin(); first != order.end(); first += 8) {
      std::shuffle(first, first + 8, random);
    }
    EarlyStop shuffled(stopping(0.1, 1000));
    for (const int i : order) shuffled.add(nth_throw(i));
    EXPECT_EQ(shuffled.end(), in_order.end());
    EXPECT_EQ(shuffled.text(), in_order.text());
  }
}

TEST(EarlyStop, StatesAWiderIntervalWhenItHasNotCome) {
  EarlyStop stop(stopping(0.1, 1000));
  for (int i = 0; i < 20; ++i) stop.add(nth_throw(i));
  EXPECT_FALSE(stop.end());
  EXPECT_THAT(stop.text(), HasSubstr("Not ended by stop after 20 throws: 14 of 18 dodged"));
}

// Of the throws that tables count, whichever are missing.
TEST(EarlyStop, UnderWayCountsAllThrowsThatAreThere) {
  EarlyStop gap(stopping(0.1, 1000));
  for (int i = 0; i < 21; ++i) {
    if (i != 3) gap.add(nth_throw(i));
  }
  EXPECT_FALSE(gap.end());
  EXPECT_THAT(gap.text(), HasSubstr("Not ended by stop after 20 throws: 13 of 17 dodged"));
  const Interval interval = gap.interval().interval, expected = confidence_sequence(13, 17);
  EXPECT_EQ(interval.lo, expected.lo);
  EXPECT_EQ(interval.hi, expected.hi);
}

// The rule's own interval, though not every throw would have hit: not that of a campaign under way.
TEST(EarlyStop, WhereAllThrowsAreFlownTheIntervalIsTheRules) {
  EarlyStop stop(stopping(0.05, 60));
  for (int i = 0; i < 60; ++i) stop.add(nth_throw(i));
  EXPECT_FALSE(stop.end());
  const FixedWidthRule rule = FixedWidthRule(0.05, 0.95, 60).run_out(54);
  const Interval interval = stop.interval().interval, expected = rule.interval(42, 54);
  EXPECT_EQ(interval.lo, expected.lo);
  EXPECT_EQ(interval.hi, expected.hi);
  EXPECT_LT(interval.half_width(), 0.75 * confidence_sequence(42, 54).half_width());
  EXPECT_THAT(stop.text(), HasSubstr("All 60 throws flown: 42 of 54 dodged, 95 % interval 0."));
  EXPECT_THAT(stop.text(), HasSubstr("; known to +- 0.1"));
  EXPECT_THAT(stop.text(), HasSubstr(", asked for: +- 0.05)."));
}

TEST(EarlyStop, OfThrowsThatAllWouldHaveHitIsNotEndedByTheLastOne) {
  EarlyStop stop(stopping(0.05, 40));
  for (int i = 0; i < 40; ++i) {
    ThrowResult result = nth_throw(i);
    result.none = flown(true);
    stop.add(result);
  }
  EXPECT_FALSE(stop.end());
  EXPECT_THAT(stop.text(), ::testing::StartsWith("All 40 throws flown: "));
}

TEST(EarlyStop, WhereNothingWouldHaveHitNothingIsKnown) {
  EarlyStop stop(stopping(0.1, 5));
  for (int i = 0; i < 5; ++i) {
    ThrowResult result = nth_throw(i);
    result.none = flown(false);
    stop.add(result);
  }
  EXPECT_EQ(stop.interval().interval.lo, 0);
  EXPECT_EQ(stop.interval().interval.hi, 1);
}

}  // namespace
}  // namespace dodgesim
