// What is drawn at once: a region of what a camera sees.
#pragma once

#include <Eigen/Dense>

#include "sim/camera/camera.h"

namespace dodgesim {

struct Shot {
  Intrinsics intrinsics;
  Eigen::Isometry3d X_WC;
  Rect region;          // within the image
  double lod_bias = 0;  // added to the level of the mip-maps: -1 reads textures twice as sharply
};

}  // namespace dodgesim
