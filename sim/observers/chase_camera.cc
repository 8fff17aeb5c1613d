#include "sim/observers/chase_camera.h"

#include <cmath>
#include <numbers>

namespace dodgesim {

const PictureView& ChaseCamera::follow(const BodyState& vehicle) {
  constexpr double kAheadM = 1.1;    // of the vehicle: what is looked at
  constexpr double kBesideDeg = 60;  // from the vehicle's heading
  constexpr double kElevationDeg = -15;
  if (!followed_W_) {
    followed_W_ = vehicle.p_W;
    const Eigen::Vector3d forward_W = vehicle.q_W * Eigen::Vector3d::UnitX();
    view_.look_at_W = vehicle.p_W + kAheadM * Eigen::Vector3d(forward_W.x(), forward_W.y(), 0);
    view_.azimuth_deg =
        std::atan2(forward_W.y(), forward_W.x()) * 180 / std::numbers::pi + kBesideDeg;
    view_.elevation_deg = kElevationDeg;
  }
  const Eigen::Vector3d away_W = vehicle.p_W - *followed_W_;
  if (away_W.norm() > kLeashM) {
    const Eigen::Vector3d step_W = (1 - kLeashM / away_W.norm()) * away_W;
    *followed_W_ += step_W;
    view_.look_at_W += step_W;
  }
  return view_;
}

}  // namespace dodgesim
