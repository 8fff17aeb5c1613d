#include "dodge/monitor/landing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dodge {
namespace {

constexpr TimeUs kReadingEveryUs = 5000;

// What the command makes up for, at the instant of a reading high above the ground.
double drift_mps(const Landing& landing, TimeUs now_us) {
  return landing.command(now_us).v_W.z() + LandingConfig().descent_mps;
}

// Readings at a constant true height while the estimate drifts.
Landing after_drift(double rate_mps, double height_m, TimeUs end_us = 3000000) {
  Landing landing({});
  for (TimeUs t = 0; t <= end_us; t += kReadingEveryUs) {
    landing.add(t, 5 + rate_mps * seconds(t), height_m);
  }
  return landing;
}

TEST(Landing, GoesStraightDownAndSlowlyNearTheGround) {
  const LandingConfig config;
  const VelocityCommand high = after_drift(0, 3).command(3000000);
  EXPECT_TRUE(high.landing);
  EXPECT_FALSE(high.evading);
  EXPECT_TRUE(high.v_W.isApprox(Eigen::Vector3d(0, 0, -config.descent_mps), 1e-9));
  const VelocityCommand low = after_drift(0, config.slow_below_m - 0.01).command(3000000);
  EXPECT_TRUE(low.v_W.isApprox(Eigen::Vector3d(0, 0, -config.touchdown_mps), 1e-9));
}

TEST(Landing, IsSlowWhereTheHeightIsNotKnown) {
  const LandingConfig config;
  EXPECT_NEAR(Landing({}).command(1000000).v_W.z(), -config.touchdown_mps, 1e-9);
  const Landing landing = after_drift(0, 3);
  EXPECT_NEAR(landing.command(3000000 + config.fresh_us).v_W.z(), -config.descent_mps, 1e-9);
  EXPECT_NEAR(landing.command(3000001 + config.fresh_us).v_W.z(), -config.touchdown_mps, 1e-9);
}

// The controller holds the estimated velocity, which is wrong by the drift.
TEST(Landing, MakesUpForTheDriftOfTheEstimate) {
  const LandingConfig config;
  for (const double rate_mps : {-2.0, -0.3, 0.1, 1.5}) {
    const Landing landing = after_drift(rate_mps, 3);
    EXPECT_NEAR(landing.command(3000000).v_W.z(), rate_mps - config.descent_mps,
                1e-3 * std::abs(rate_mps));
  }
}

TEST(Landing, AStepOfTheGroundIsNoDrift) {
  Landing landing = after_drift(0.2, 3);
  const double before_mps = drift_mps(landing, 3000000);
  // Over a table and past it.
  for (TimeUs t = 3000000 + kReadingEveryUs; t < 4000000; t += kReadingEveryUs) {
    landing.add(t, 5 + 0.2 * seconds(t), t < 3500000 ? 2.2 : 3.0);
    EXPECT_NEAR(drift_mps(landing, t), before_mps, 1e-3);
  }
}

TEST(Landing, APauseInTheReadingsIsNoDrift) {
  Landing landing = after_drift(0.2, 3);
  landing.add(4000000, 5.7, 3);  // not where 0.2 m/s would have put it, 5.8
  EXPECT_NEAR(drift_mps(landing, 4000000), 0.2, 1e-3);
}

TEST(Landing, TimeThatGoesBackIsNoDrift) {
  Landing landing = after_drift(0, 3);
  landing.add(13000000, 5, 3);  // stamped far in the future
  for (const TimeUs t : {2950000, 2955000, 2905000, 2910000}) {
    landing.add(t, t < 2950000 ? 5.24 : 5.12, 3);
    EXPECT_NEAR(drift_mps(landing, t), 0, 1e-3) << t;
  }
}

TEST(Landing, TheNoiseOfTheSensorHardlyShakesTheCommand) {
  // +-2 cm in turn.
  Landing landing({});
  double largest_mps = 0;
  for (TimeUs t = 0; t < 5000000; t += kReadingEveryUs) {
    const double noise_m = (t / kReadingEveryUs % 2 == 0 ? 0.02 : -0.02);
    landing.add(t, 5, 3 + noise_m);
    if (t > 1000000) largest_mps = std::max(largest_mps, std::abs(drift_mps(landing, t)));
  }
  EXPECT_LT(largest_mps, 0.01);
}

TEST(Landing, TwoReadingsOfOneInstantDoNoHarm) {
  Landing landing = after_drift(0, 3);
  landing.add(3000000, 5.01, 3);
  EXPECT_NEAR(drift_mps(landing, 3000000), 0, 1e-9);  // not NaN either
}

}  // namespace
}  // namespace dodge
