// Rotation vectors.
#pragma once

#include <Eigen/Dense>

namespace dodgesim {

// By the vector's length [rad], about its direction.
inline Eigen::Quaterniond rotation(const Eigen::Vector3d& vector_rad) {
  const double angle_rad = vector_rad.norm();
  if (angle_rad == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, vector_rad / angle_rad));
}

}  // namespace dodgesim
