// What a scenario changes about the model of its vehicle. Physics, flight controller and pilot are
// all told: it is another vehicle, not a wrong idea of the same one. Only of lower_camera_turn_deg
// the pilot knows nothing.
#pragma once

#include <Eigen/Dense>
#include <numbers>
#include <optional>

namespace dodgesim {

struct VehicleOverrides {
  double mass_scale = 1;
  double inertia_scale = 1;
  double max_thrust_n = 0;
  double stereo_baseline_m = 0;
  Eigen::Vector3d lower_camera_turn_deg = Eigen::Vector3d::Zero();

  // From the turned camera's frame to the one without; empty if there is no turn.
  std::optional<Eigen::AngleAxisd> lower_camera_turn() const {
    const double angle_rad = lower_camera_turn_deg.norm() * std::numbers::pi / 180;
    if (angle_rad == 0) return std::nullopt;
    return Eigen::AngleAxisd(angle_rad, lower_camera_turn_deg.normalized());
  }

  template <class Visitor>
  void visit(Visitor& v) {
    v("mass_scale", mass_scale, 0.1, 10,
      "Factor on the vehicle's mass; of the nominal vehicle at least 0.6 of inertia_scale. Its air "
      "drag, a force, stays "
      "what it is.");
    v("inertia_scale", inertia_scale, 0.1, 10,
      "Factor on its moments of inertia. Lower it with the mass: rotors that have to turn the "
      "inertia of a heavier vehicle lift a light one whenever they tilt it.");
    v("max_thrust_n", max_thrust_n, 0, 1000,
      "Greatest thrust of a rotor, in place of the model's; 0: as in the model. Four times "
      "controller.max_thrust_fraction of it must lift at least 1.2 times the weight; with the "
      "default fraction of 0.9 that is 1.33 times the weight at full thrust.");
    v("stereo_baseline_m", stereo_baseline_m, 0, 1,
      "Distance between the two cameras, each moved as far from their middle, which stays; the "
      "pilot's calibration has it, too. The hull stays as it is. 0: as in the model.");
    v("lower_camera_turn_deg", lower_camera_turn_deg, -5, 5,
      "An error of calibration: the lower camera is turned about its own axes (right, down, and "
      "ahead), and the pilot does not know. [0.1, 0, 0]: it looks 0.1 degrees higher; at 80 "
      "degrees over 320 columns disparities are 0.33 px too small, and things seem farther. With "
      "two cameras only.");
  }
};

}  // namespace dodgesim
