#include "sim/render/camera.h"

#include <cmath>
#include <numbers>

namespace dodgesim {

double focal_length_px(int width, double horizontal_fov_deg) {
  return 0.5 * width / std::tan(horizontal_fov_deg * std::numbers::pi / 360.0);
}

}  // namespace dodgesim
