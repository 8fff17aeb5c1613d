// Two calibrations as those of a pair, one camera above the other, as the pilots' stereo wants it.
#pragma once

#include <utility>

#include "sim/config/camera_calibration.h"

namespace dodgesim {

struct StereoPair {
  CameraCalibration upper, lower;  // with a lens (CameraModel::lens) unless they were rectified
};

// Turns both cameras' frames C to one orientation, in which the lower camera lies straight below
// the upper one, and gives both the same focal length and principal point, the means of their own
// (Fusiello, Trucco and Verri, "A compact algorithm for rectification of stereo pairs", 2000). The
// pixels stay where they are: CameraModel::lens says how they map to C. Of a chain (Kalibr), B is
// that of the upper camera. Throws ScenarioError if the lower camera is not below the upper one, to
// within 30 degrees of both images' columns. Images of two sizes are left as they are.
StereoPair rectified(const CameraCalibration& upper, const CameraCalibration& lower);

}  // namespace dodgesim
