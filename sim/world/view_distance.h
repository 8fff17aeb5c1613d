// How near the static scene is in a camera's view, by rays on a grid.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "sim/render/camera.h"
#include "sim/world/world.h"

namespace dodgesim {

// The value decides how often a camera must be sampled while it translates. It is a bound only up
// to what the rays miss; the rays are a sixteenth of the image apart, and furniture is larger.
class ViewDistance {
 public:
  explicit ViewDistance(const Intrinsics& intrinsics);

  // Smallest distance from the camera to the room [m], less what the vehicle may have moved since
  // the rays were cast. `now` must be the world's snapshot. Infinite in an empty view.
  double nearest_m(const World& world, const Snapshot& now, const Eigen::Isometry3d& X_BC);

 private:
  void cast(const World& world, const Eigen::Isometry3d& X_WC);

  std::vector<Eigen::Vector3d> rays_C_;  // unit vectors, corners of the image included
  TimeUs cast_us_ = -1;
  Eigen::Vector3d cast_p_W_ = Eigen::Vector3d::Zero();
  double cast_m_ = 0;
};

}  // namespace dodgesim
