// The course of a throw for the eye: poses about every 20 ms, to a millimetre, in some 10 bytes
// each. Exact numbers come from flying the throw again (dodgesim replay).
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/time.h"

namespace dodgesim {

struct Trajectory {
  struct Sample {
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();            // the vehicle
    Eigen::Quaterniond q_W = Eigen::Quaterniond::Identity();  // body to world
    Eigen::Vector3d command_W = Eigen::Vector3d::Zero();      // velocity asked of the controller
    bool evading = false;                                     // an obstacle's force is part of it
    std::vector<std::optional<Eigen::Vector3d>> objects;      // empty: not launched yet
  };
  struct Detection {
    TimeUs output_us = 0;
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
    bool true_object = false;  // it is of an object
  };

  TimeUs start_us = 0, period_us = 0;  // of the samples; the last one is at end_us
  TimeUs end_us = 0;
  std::vector<double> sizes_m;  // diameters of the objects
  std::vector<Sample> samples;
  std::vector<Detection> detections;  // in order of time
};

// Positions are rounded to 1 mm, those of detections to 1 cm, velocities to 0.1 m/s, components of
// the quaternion to 0.01, times to a tick, those of detections to 1 ms. Components are written as
// what they differ from their prediction (positions: constant velocity; others: no change), as
// varints. sim/tables/report/trajectory.js reads them, too.
std::string to_bytes(const Trajectory& trajectory);

// Throws IoError when the bytes are not one whole trajectory.
Trajectory trajectory_from_bytes(std::string_view bytes);

}  // namespace dodgesim
