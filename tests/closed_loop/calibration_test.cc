// What a pilot makes of a lower camera that looks elsewhere than it believes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/flight/setup.h"
#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

Scenario thrown_at(const std::string& turn_deg) {
  return scenario(
      "mission: {start_m: [-2, 0, 2]}\n"
      "throw: {distance_m: 3, speed_mps: 5, launch_height_m: 1.7, launch_s: 0.2}\n"
      "dodger: {position: {max_range_m: 4}, repulsive: {k_r0: 0}}\n"
      "vehicle_overrides: {lower_camera_turn_deg: " +
      turn_deg + "}\n");
}

// Median over the detections of a throw: seen less true disparity, b / Z, over the focal length.
double disparity_error_rad(const std::string& turn_deg) {
  const Scenario s = thrown_at(turn_deg);
  FlightPlan plan = plan_throw(s, 0);
  plan.end_us = plan.launches.at(0).drawn.launch_us + 350000;
  const FlightRecord record = fly(s, plan);
  constexpr double kBaselineM = 0.15;
  std::vector<double> errors;
  for (const DetectionRow& row : record.detections.rows) {
    const double true_m = row.true_depth_m.value();
    errors.push_back((1 / row.depth_m - 1 / true_m) * kBaselineM);
  }
  EXPECT_GT(errors.size(), 10u);
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

TEST(CalibrationError, OfTheLowerCamerasPitchIsOneOfTheDisparity) {
  constexpr double kTurnRad = 0.3 * M_PI / 180;
  const double usual_rad = disparity_error_rad("[0, 0, 0]");
  EXPECT_NEAR(disparity_error_rad("[0.3, 0, 0]") - usual_rad, -kTurnRad, 0.2 * kTurnRad);
  EXPECT_NEAR(disparity_error_rad("[-0.3, 0, 0]") - usual_rad, kTurnRad, 0.2 * kTurnRad);
}

TEST(CalibrationError, IsUnknownToThePilot) {
  const Scenario right = thrown_at("[0, 0, 0]"), wrong = thrown_at("[0.3, -0.2, 0.1]");
  const auto known = [](const Scenario& s) {
    return camera_models(s, World(world_spec(s, {})).vehicle());
  };
  for (std::size_t camera : {0, 1}) {
    EXPECT_TRUE(known(wrong)[camera].X_BC.isApprox(known(right)[camera].X_BC, 1e-12));
  }
}

}  // namespace
}  // namespace dodgesim
