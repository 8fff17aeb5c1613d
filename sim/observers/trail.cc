#include "sim/observers/trail.h"

#include <algorithm>

namespace dodgesim {

void Trail::extend(const Snapshot& now) {
  const Eigen::Vector4f vehicle_colour(0.1F, 0.6F, 1.0F, 1.0F);
  const Eigen::Vector4f object_colour(1.0F, 0.35F, 0.1F, 1.0F);
  dots_.push_back({now.vehicle.p_W, radius_m_, vehicle_colour});
  for (std::size_t i = 0; i < now.objects.size(); ++i) {
    if (now.launched[i]) dots_.push_back({now.objects[i].p_W, radius_m_, object_colour});
  }
  const std::size_t over = dots_.size() - std::min(dots_.size(), most_);
  dots_.erase(dots_.begin(), dots_.begin() + static_cast<std::ptrdiff_t>(over));
}

}  // namespace dodgesim
