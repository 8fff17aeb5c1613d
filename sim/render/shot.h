// What is drawn at once: a region of what a camera sees.
#pragma once

#include <Eigen/Dense>

#include "sim/render/camera.h"

namespace dodgesim {

struct Shot {
  Intrinsics intrinsics;
  Eigen::Isometry3d X_WC;
  Rect region;  // within the image
};

}  // namespace dodgesim
