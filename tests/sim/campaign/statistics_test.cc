#include "sim/campaign/statistics.h"

#include <gtest/gtest.h>

namespace dodgesim {
namespace {

// Newcombe 1998 (Statistics in Medicine 17:857), table I, method 3 (score without continuity
// correction), 95 %.
TEST(Wilson, AgreesWithPublishedIntervals) {
  const struct {
    int successes, trials;
    double lo, hi;
  } published[] = {
      {81, 263, 0.2553, 0.3662},
      {15, 148, 0.0624, 0.1605},
      {0, 20, 0.0000, 0.1611},
      {1, 29, 0.0061, 0.1718},
  };
  for (const auto& [successes, trials, lo, hi] : published) {
    const Interval interval = wilson(successes, trials);
    EXPECT_NEAR(interval.lo, lo, 5e-5) << successes << "/" << trials;
    EXPECT_NEAR(interval.hi, hi, 5e-5) << successes << "/" << trials;
  }
}

TEST(Wilson, NinetyTwoOfAHundred) {
  EXPECT_NEAR(wilson(92, 100).lo, 0.850, 5e-4);
  EXPECT_NEAR(wilson(92, 100).hi, 0.959, 5e-4);
}

TEST(Wilson, StaysInsideTheUnitIntervalAndMirrors) {
  EXPECT_EQ(wilson(0, 5).lo, 0);
  EXPECT_EQ(wilson(5, 5).hi, 1);
  EXPECT_NEAR(wilson(2, 9).lo, 1 - wilson(7, 9).hi, 1e-15);
}

TEST(Wilson, NothingIsKnownWithoutTrials) {
  EXPECT_EQ(wilson(0, 0).lo, 0);
  EXPECT_EQ(wilson(0, 0).hi, 1);
}

TEST(Wilson, WidensWithConfidence) { EXPECT_LT(wilson(8, 10, 0.99).lo, wilson(8, 10, 0.9).lo); }

}  // namespace
}  // namespace dodgesim
