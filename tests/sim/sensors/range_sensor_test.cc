#include "sim/sensors/range_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "sim/base/error.h"

namespace dodgesim {
namespace {

TEST(RangeSensor, WithoutNoiseItTellsTheTruthInSteps) {
  RangeSpec spec;
  spec.sigma_m = spec.sigma_fraction = 0;
  RangeSensor sensor(spec, 1, 0);
  EXPECT_NEAR(sensor.sample(0, 1.2341)->range_m, 1.235, 1e-12);
  spec.resolution_m = 0;
  RangeSensor fine(spec, 1, 0);
  EXPECT_DOUBLE_EQ(fine.sample(5000, 1.2341)->range_m, 1.2341);
  EXPECT_EQ(fine.sample(10000, 1)->t_us, 10000);
}

TEST(RangeSensor, OutOfRangeGivesNoReading) {
  RangeSensor sensor(RangeSpec(), 1, 0);
  const RangeSpec spec;
  EXPECT_FALSE(sensor.sample(0, spec.min_range_m - 0.001));
  EXPECT_TRUE(sensor.sample(0, spec.min_range_m));
  EXPECT_TRUE(sensor.sample(0, spec.max_range_m));
  EXPECT_FALSE(sensor.sample(0, spec.max_range_m + 0.001));
  EXPECT_FALSE(sensor.sample(0, std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(sensor.sample(0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(sensor.sample(0, 2));
}

TEST(RangeSensor, NoiseHasItsSizeNearAndFar) {
  RangeSpec spec;
  spec.resolution_m = 0;
  constexpr int kSamples = 10000;
  // As the data sheet of the TeraRanger Evo 60m has it, as two sigma: 4 cm up to 14 m, then 1.5 %.
  const std::vector<std::pair<double, double>> expected = {
      {1, 0.02}, {10, 0.02}, {14, 0.02}, {14.1, 0.0075 * 14.1}, {40, 0.3}};
  for (const auto& [range_m, sigma] : expected) {
    RangeSensor sensor(spec, 1, 0);
    double variance = 0, mean = 0;
    for (int n = 0; n < kSamples; ++n) {
      const double error = sensor.sample(n * 5000, range_m)->range_m - range_m;
      mean += error / kSamples;
      variance += error * error / kSamples;
    }
    EXPECT_NEAR(mean / sigma, 0, 4 / std::sqrt(kSamples));
    EXPECT_NEAR(variance / (sigma * sigma), 1, 4 * std::sqrt(2.0 / kSamples));
  }
}

// What lies below must not shift the noise of later readings.
TEST(RangeSensor, AMissingReadingDoesNotShiftTheNoise) {
  RangeSensor a(RangeSpec(), 1, 0);
  RangeSensor b(RangeSpec(), 1, 0);
  a.sample(0, 2);
  b.sample(0, 100);
  EXPECT_EQ(a.sample(5000, 2)->range_m, b.sample(5000, 2)->range_m);
}

TEST(RangeSensor, RefusesARateThatDoesNotFitTheTicks) {
  RangeSpec spec;
  spec.rate_hz = 240;
  EXPECT_THROW(RangeSensor(spec, 1, 0), ScenarioError);
}

}  // namespace
}  // namespace dodgesim
