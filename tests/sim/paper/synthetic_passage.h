// Flights past the cameras that nobody has flown, for the tests of what is counted of them.
#pragma once

#include "sim/config/scenario.h"
#include "sim/outcome/result.h"
#include "sim/outcome/trajectory.h"
#include "sim/paper/passage.h"
#include "tests/models.h"

namespace dodgesim {

inline Scenario paper_scenario(const std::string& text) {
  return parse_scenario(text, "test.yaml", testing::kModels);
}

// Two cameras at the origin of a body at rest, looking along its x axis, one 15 cm above the other.
inline CameraRig stereo_rig() {
  CameraRig rig;
  for (const double z : {0.075, -0.075}) {
    Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
    X_BC.linear().col(0) = -Eigen::Vector3d::UnitY();
    X_BC.linear().col(1) = -Eigen::Vector3d::UnitZ();
    X_BC.linear().col(2) = Eigen::Vector3d::UnitX();
    X_BC.translation().z() = z;
    rig.X_BC.push_back(X_BC);
  }
  return rig;
}

// A ball that flies straight on for a second past a vehicle at rest in the origin.
inline Trajectory straight_flight(const Eigen::Vector3d& from_W, const Eigen::Vector3d& v_W,
                                  double size_m) {
  Trajectory trajectory;
  trajectory.start_us = 500000;
  trajectory.period_us = 20000;
  trajectory.end_us = 1500000;
  trajectory.sizes_m = {size_m};
  for (int i = 0; i <= 50; ++i) {
    Trajectory::Sample sample;
    sample.objects = {from_W + 0.02 * i * v_W};
    trajectory.samples.push_back(sample);
  }
  return trajectory;
}

// A detection at p_W while the ball is at true_p_W.
inline DetectionRow detection(TimeUs t_us, const Eigen::Vector3d& p_W,
                              const Eigen::Vector3d& true_p_W, double true_depth_m) {
  DetectionRow row;
  row.t_us = t_us;
  row.p_W = {p_W.x(), p_W.y(), p_W.z()};
  row.size_m = 0.1;
  row.object = 0;
  row.true_p_W = {true_p_W.x(), true_p_W.y(), true_p_W.z()};
  row.position_error_m = (p_W - true_p_W).norm();
  row.true_depth_m = true_depth_m;
  return row;
}

}  // namespace dodgesim
