// The usual mounting of a camera.
#pragma once

#include <Eigen/Dense>

namespace dodgesim {

// R_BC of a camera whose z looks along x of B, with y down.
inline Eigen::Matrix3d looking_forward() {
  Eigen::Matrix3d R_BC;
  R_BC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return R_BC;
}

}  // namespace dodgesim
