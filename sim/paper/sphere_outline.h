// The outline of a sphere in a flat image.
#pragma once

#include <Eigen/Dense>

namespace dodgesim {

// Length of the outline of a sphere in the radial direction, its longer side, in focal lengths. Off
// the axis it is longer than size / depth, which the paper's eq. (7) takes it for: a flat image
// stretches what is aside. Of a sphere that is not wholly ahead of the camera, the part that is.
double outline_length(const Eigen::Vector3d& p_C, double size_m);

// Where a sphere is whose outline is as long as eq. (7) would have it at flat_p_C: in the same
// direction, farther away.
Eigen::Vector3d unstretched(const Eigen::Vector3d& flat_p_C, double size_m);

}  // namespace dodgesim
