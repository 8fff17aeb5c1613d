#include "dodge/monitor/range_height.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace dodge {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const Eigen::Vector3d kMount(-0.05, 0.02, -0.045);

StateEstimate tilted(double angle_rad, const Eigen::Vector3d& axis) {
  StateEstimate state;
  state.p_WB = {1, -2, 7};  // the estimate's own height plays no part
  state.q_WB = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) *
               Eigen::AngleAxisd(angle_rad, axis.normalized());
  return state;
}

// What a sensor at the mount reads `height_m` above flat ground: where its ray meets the plane.
double range_at(double height_m, const StateEstimate& state) {
  const Eigen::Vector3d sensor_W =
      Eigen::Vector3d(0, 0, height_m) + state.q_WB.toRotationMatrix() * kMount;
  const Eigen::Vector3d down_W = state.q_WB * Eigen::Vector3d(0, 0, -1);
  return sensor_W.z() / -down_W.z();
}

TEST(RangeHeight, IsThatOfTheOriginWhateverTheTilt) {
  const RangeSensorConfig config;
  for (const double degrees : {0.0, 10.0, 29.0}) {
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(1, 2, 0)}) {
      const StateEstimate state = tilted(degrees * kDegree, axis);
      const auto height_m = height_above_ground(config, kMount, {0, range_at(2, state)}, state);
      ASSERT_TRUE(height_m) << degrees;
      EXPECT_NEAR(*height_m, 2, 1e-12);
    }
  }
}

TEST(RangeHeight, IsUnknownAtLargeTilt) {
  const RangeSensorConfig config;
  for (const double degrees : {31.0, 75.0, 90.0, 180.0}) {
    const StateEstimate state = tilted(degrees * kDegree, Eigen::Vector3d::UnitX());
    EXPECT_FALSE(height_above_ground(config, kMount, {0, 2}, state)) << degrees;
  }
}

TEST(RangeHeight, IsUnknownOutOfTheSensorsRangeOrWithoutNumbers) {
  const RangeSensorConfig config;
  const StateEstimate level;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double range_m : {-1.0, 0.0, 0.49, 60.1, kInfinity, std::nan("")}) {
    EXPECT_FALSE(height_above_ground(config, kMount, {0, range_m}, level)) << range_m;
  }
  EXPECT_TRUE(height_above_ground(config, kMount, {0, 0.5}, level));
  EXPECT_TRUE(height_above_ground(config, kMount, {0, 60}, level));
  StateEstimate broken;
  broken.p_WB.z() = std::nan("");
  EXPECT_FALSE(height_above_ground(config, kMount, {0, 2}, broken));
  broken = level;
  broken.q_WB.x() = std::nan("");
  EXPECT_FALSE(height_above_ground(config, kMount, {0, 2}, broken));
}

}  // namespace
}  // namespace dodge
