#pragma once

#include <Eigen/Dense>

#include "sim/base/random.h"

namespace dodgesim {

// Turned anyhow, and up to reach_m away along each axis.
inline Eigen::Isometry3d random_pose(RandomStream& random, double reach_m) {
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = q.normalized().toRotationMatrix();
  for (int k = 0; k < 3; ++k) X.translation()[k] = random.uniform(-reach_m, reach_m);
  return X;
}

}  // namespace dodgesim
