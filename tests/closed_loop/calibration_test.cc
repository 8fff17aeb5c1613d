#include <gtest/gtest.h>

#include <cmath>

#include "dodge/camera_model.h"
#include "sim/flight.h"
#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

std::vector<dodge::CameraModel> cameras(const std::string& error_deg) {
  const Scenario wrong =
      scenario("sensors: {camera: {calibration_error_deg: " + error_deg + "}}\n");
  return camera_models(wrong, World(world_spec(wrong, {})).vehicle());
}

TEST(CalibrationError, IsOfTheLowerCamerasDirectionAlone) {
  const auto right = cameras("[0, 0, 0]"), wrong = cameras("[0.3, -0.2, 0.1]");
  ASSERT_EQ(wrong.size(), 2U);
  EXPECT_TRUE(wrong[0].X_BC.isApprox(right[0].X_BC, 0));
  EXPECT_TRUE(wrong[1].X_BC.translation().isApprox(right[1].X_BC.translation(), 0));
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(right[1].X_BC.linear().transpose() * wrong[1].X_BC.linear()));
  EXPECT_NEAR(turn.angle(), std::sqrt(0.14) * M_PI / 180, 1e-9);
  EXPECT_TRUE(turn.axis().isApprox(Vector3d(0.3, -0.2, 0.1).normalized(), 1e-6));
}

// A pilot that believes its lower camera looks higher than it does expects things lower in its
// image.
TEST(CalibrationError, AboutTheFirstAxisShiftsTheDisparity) {
  const auto right = cameras("[0, 0, 0]"), wrong = cameras("[0.1, 0, 0]");
  const Vector3d p_B = right[1].X_BC * Vector3d(0, 0, 2);
  const auto row = [&](const dodge::CameraModel& camera) {
    return camera.project(camera.X_BC.inverse() * p_B).y();
  };
  EXPECT_NEAR(row(wrong[1]) - row(right[1]), right[1].fy * std::tan(0.1 * M_PI / 180), 1e-9);
  EXPECT_NEAR(row(wrong[1]) - row(right[1]), 0.33, 0.01);
}

}  // namespace
}  // namespace dodgesim
