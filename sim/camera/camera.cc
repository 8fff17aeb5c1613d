#include "sim/camera/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dodgesim {

double focal_length_px(int width, double horizontal_fov_deg) {
  return 0.5 * width / std::tan(horizontal_fov_deg * std::numbers::pi / 360.0);
}

Rect intersection(const Rect& a, const Rect& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

Rect merged(const Rect& a, const Rect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

}  // namespace dodgesim
