// Thresholds have the mean and the spread that the camera says, or the check fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/normal_distribution.h"
#include "sim/check/thresholds.h"
#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

TEST(ThresholdCheck, FailsForOtherThresholds) {
  EventCameraSpec broken;
  broken.contrast_threshold_on = 0.202;
  EXPECT_EQ(failures(judge(measure_thresholds(broken, 1), EventCameraSpec())),
            Names{"threshold.on.mean"});
  broken = EventCameraSpec();
  broken.contrast_threshold_off = 0.198;
  EXPECT_EQ(failures(judge(measure_thresholds(broken, 1), EventCameraSpec())),
            Names{"threshold.off.mean"});
}

TEST(ThresholdCheck, FailsForAnotherMismatch) {
  EventCameraSpec broken;
  broken.mismatch_sigma = 0.032;
  EXPECT_EQ(failures(judge(measure_thresholds(broken, 1), EventCameraSpec())),
            (Names{"threshold.on.sd", "threshold.off.sd"}));
}

TEST(ThresholdCheck, KnowsThatThresholdsAreCut) {
  // Against sums over quantiles.
  for (const double lowest : {-5.0, 0.0, 0.1, 0.25, 2.0}) {
    double mean = 0, square = 0;
    constexpr int kCount = 200000;
    for (int i = 0; i < kCount; ++i) {
      const double x = std::max(lowest, 0.2 + 0.1 * normal_quantile((i + 0.5) / kCount));
      mean += x / kCount;
      square += x * x / kCount;
    }
    const Moments moments = clipped_normal(0.2, 0.1, lowest);
    EXPECT_NEAR(moments.mean, mean, 1e-6);
    EXPECT_NEAR(moments.sd, std::sqrt(std::max(0.0, square - mean * mean)), 1e-4);
  }
  EXPECT_EQ(clipped_normal(0.2, 0, 0.3).mean, 0.3);
  EXPECT_EQ(clipped_normal(0.2, 0, 0.3).sd, 0);
}

}  // namespace
}  // namespace dodgesim
