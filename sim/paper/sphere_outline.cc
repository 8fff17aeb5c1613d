#include "sim/paper/sphere_outline.h"

#include <algorithm>
#include <cmath>

namespace dodgesim {

namespace {

constexpr double kMostRad = 1.5;  // off the axis: what is beside the camera is in no image

}  // namespace

double outline_length(const Eigen::Vector3d& p_C, double size_m) {
  const double off_axis_rad = std::atan2(p_C.head<2>().norm(), p_C.z());
  const double half_rad =
      std::min(std::asin(std::min(1.0, 0.5 * size_m / p_C.norm())), kMostRad - off_axis_rad);
  return std::tan(off_axis_rad + half_rad) - std::tan(off_axis_rad - half_rad);
}

// The length is nearly in inverse proportion to the distance: each step leaves a small part of the
// error.
Eigen::Vector3d unstretched(const Eigen::Vector3d& flat_p_C, double size_m) {
  constexpr int kSteps = 20;
  const double length = size_m / flat_p_C.z();
  Eigen::Vector3d p_C = flat_p_C;
  for (int i = 0; i < kSteps; ++i) p_C *= outline_length(p_C, size_m) / length;
  return p_C;
}

}  // namespace dodgesim
