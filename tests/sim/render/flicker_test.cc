#include "sim/render/flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dodgesim {
namespace {

TEST(Flicker, IsASineAroundOneOfTheSetFrequencyDepthAndPhase) {
  const FlickerSpec spec = {100, 0.3};
  EXPECT_NEAR(flicker_factor(spec, 0, 0), 1, 1e-12);
  EXPECT_NEAR(flicker_factor(spec, 0, 2500), 1.3, 1e-12);  // a quarter of 10 ms
  EXPECT_NEAR(flicker_factor(spec, 0, 7500), 0.7, 1e-12);
  EXPECT_NEAR(flicker_factor(spec, std::numbers::pi / 2, 0), 1.3, 1e-12);
  EXPECT_NEAR(flicker_factor(spec, 0, 3600000002500), 1.3, 1e-6);  // still after an hour
  double mean = 0;
  for (TimeUs t = 0; t < 10000; ++t) mean += flicker_factor(spec, 0.7, t) / 10000;
  EXPECT_NEAR(mean, 1, 1e-9);
}

TEST(Flicker, OfDepthOneIsDarkOnceAPeriodAndNeverNegative) {
  const FlickerSpec spec = {120, 1};
  double least = 1;
  for (TimeUs t = 0; t < 100000; ++t) {
    const double factor = flicker_factor(spec, 0.3, t);
    EXPECT_GE(factor, 0);
    least = std::min(least, factor);
  }
  EXPECT_LT(least, 1e-5);
}

TEST(Flicker, IsOffAtZero) {
  for (TimeUs t = 0; t < 100000; t += 137) {
    EXPECT_EQ(flicker_factor({0, 0.5}, 1, t), 1);
    EXPECT_EQ(flicker_factor({100, 0}, 1, t), 1);
  }
  EXPECT_EQ(flicker_sampling_hz({0, 0.5}), 0);
  EXPECT_EQ(flicker_sampling_hz({100, 0}), 0);
}

TEST(Flicker, IsFollowedByStraightLinesBetweenTheSamplesItAsksFor) {
  const FlickerSpec spec = {100, 0.5};
  const auto step_us = static_cast<TimeUs>(1e6 / flicker_sampling_hz(spec));
  ASSERT_EQ(step_us, 500);
  double farthest = 0;
  for (TimeUs t = 0; t < 20000; ++t) {
    const TimeUs before = t / step_us * step_us;
    const double share = static_cast<double>(t - before) / static_cast<double>(step_us);
    const double line = (1 - share) * flicker_factor(spec, 0, before) +
                        share * flicker_factor(spec, 0, before + step_us);
    farthest = std::max(farthest, std::abs(line - flicker_factor(spec, 0, t)));
  }
  EXPECT_LT(farthest, 0.013 * 0.5);
}

}  // namespace
}  // namespace dodgesim
