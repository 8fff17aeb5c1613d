// What the vehicle's sensors say. t_us is the instant a reading speaks of; when it arrives is the
// business of the loop's delays.
#pragma once

#include <Eigen/Dense>

#include "sim/base/time.h"

namespace dodgesim {

struct ImuReading {
  TimeUs t_us = 0;
  Eigen::Vector3d w_B_radps = Eigen::Vector3d::Zero();  // angular velocity of B in W, in B
  Eigen::Vector3d f_B_mps2 = Eigen::Vector3d::Zero();   // specific force, in B: +g along z at rest
};

struct StateReading {
  TimeUs t_us = 0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();            // [m]
  Eigen::Quaterniond q_W = Eigen::Quaterniond::Identity();  // rotates body vectors into W
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();            // [m/s]
  Eigen::Vector3d w_B = Eigen::Vector3d::Zero();            // [rad/s]
};

// How the frame of the state estimates has drifted from the world: what is at p in the world, is at
// p + p_W in theirs, and seems to be faster by v_W. The white noise of each estimate is not part of
// it, nor is the error of the heading.
struct FrameDrift {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  // [m/s]
};

struct RangeReading {
  TimeUs t_us = 0;
  double range_m = 0;  // along -z of B
};

}  // namespace dodgesim
