// Vectors as tables have them.
#pragma once

#include <Eigen/Dense>
#include <array>

namespace dodgesim {

inline std::array<double, 3> to_array(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Vector3d to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace dodgesim
