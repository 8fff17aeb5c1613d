#include "sim/playback/camera_order.h"

#include <cmath>

namespace dodgesim {

void CameraOrder::add(const std::vector<dodge::Cluster>& upper,
                      const std::vector<dodge::Cluster>& lower) {
  constexpr double kSameColumnPx = 8;  // outlines differ
  constexpr double kNearPx = 2;        // of disparity
  if (upper.size() != 1 || lower.size() != 1) return;
  const Eigen::Vector2d apart_px = upper.front().centroid - lower.front().centroid;
  if (std::abs(apart_px.x()) > kSameColumnPx || std::abs(apart_px.y()) < kNearPx) return;
  ++(apart_px.y() > 0 ? as_given_ : swapped_);
}

}  // namespace dodgesim
