// Where a sphere is in the image of a pinhole camera.
#pragma once

#include <Eigen/Dense>

#include "sim/camera/camera.h"

namespace dodgesim {

// An upright rectangle in the image [px]; may be unbounded.
using ImageBox = Eigen::AlignedBox2d;

// The smallest upright rectangle about the part of a sphere that is in front of the camera, as if
// the image had no border. Empty if nothing of the sphere is in front of the camera; unbounded
// where the sphere reaches to the side of the camera. `centre_C` [m] in C.
ImageBox sphere_bounds(const Intrinsics& intrinsics, const Eigen::Vector3d& centre_C,
                       double radius_m);

// The pixels of the image whose area comes within margin_px of the box.
Rect pixels_about(const ImageBox& box, double margin_px, const Intrinsics& intrinsics);

}  // namespace dodgesim
