#include "sim/render/flicker.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  EXPECT_NEAR(flicker_sampling_hz({100, 0.2}), 20 * 100, 0.02 * 2000);
  for (const double depth : {0.05, 0.2, 0.5, 0.9, 0.98}) {
    const FlickerSpec spec = {100, depth};
    const auto logarithm = [&spec](double t_us) {
      return std::log(1 + spec.flicker_depth * std::sin(2e-6 * M_PI * spec.flicker_hz * t_us));
    };
    const double step_us = 1e6 / flicker_sampling_hz(spec);
    double farthest = 0;
    for (double t_us = 0; t_us < 20000; ++t_us) {
      const double before_us = std::floor(t_us / step_us) * step_us;
      const double share = (t_us - before_us) / step_us;
      const double line =
          (1 - share) * logarithm(before_us) + share * logarithm(before_us + step_us);
      farthest = std::max(farthest, std::abs(line - logarithm(t_us)));
    }
    EXPECT_LT(farthest, 0.0032) << depth;                    // of a threshold of 0.2
    EXPECT_GT(farthest, depth < 0.2 ? 0 : 0.0015) << depth;  // not drawn for nothing
  }
}

}  // namespace
}  // namespace dodgesim
