#include "dodge/avoid/avoider.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace dodge {
namespace {

constexpr double kVertical = 1e-6;  // horizontal length below which an axis counts as vertical

// The vehicle's x axis without tilt: the heading of (30) is where the vehicle is turned to, not how
// far it leans into its escape.
Eigen::Vector3d heading(const Eigen::Quaterniond& q_WB) {
  const Eigen::Matrix3d R_WB = q_WB.normalized().toRotationMatrix();
  Eigen::Vector3d x = R_WB.col(0);
  if (std::hypot(x.x(), x.y()) < kVertical) x = std::copysign(1.0, -x.z()) * R_WB.col(2);
  x.z() = 0;
  return x.normalized();
}

bool acts(const TrackedObstacle& tracked) {
  const Obstacle& obstacle = tracked.obstacle;
  return tracked.confirmed && obstacle.p_WO.allFinite() && obstacle.v_WO.allFinite() &&
         std::isfinite(obstacle.size_m) && tracked.covariance.allFinite() &&
         tracked.ellipsoid.centre_W.allFinite() && tracked.ellipsoid.axes_W.allFinite() &&
         tracked.ellipsoid.semi_axes_m.allFinite();
}

}  // namespace

Avoider::Avoider(const RepulsiveConfig& repulsive, const AttractiveConfig& attractive,
                 const VelocityLimitConfig& limit, const EscapeConfig& escape)
    : repulsive_(repulsive),
      attractive_(attractive),
      limit_(limit),
      ramp_(limit),
      escape_(escape, limit.max_speed_mps),
      predicts_(escape.law == "closest_approach") {
  acting_.reserve(Tracker::kUsualObstacles);
}

VelocityCommand Avoider::command(TimeUs now_us, const StateEstimate& state, const Goal& goal,
                                 std::span<const TrackedObstacle> obstacles) {
  VehicleMotion vehicle;
  vehicle.v_W = state.v_WB;
  vehicle.p_W = state.p_WB + seconds(now_us - state.t_us) * state.v_WB;
  vehicle.heading_W = heading(state.q_WB);
  acting_.clear();
  std::copy_if(obstacles.begin(), obstacles.end(), std::back_inserter(acting_), acts);
  return ramp_.ramped(decide(now_us, vehicle, goal), vehicle.v_W);
}

VelocityCommand Avoider::decide(TimeUs now_us, const VehicleMotion& vehicle, const Goal& goal) {
  const Eigen::Vector3d attractive_W =
      attractive_velocity(attractive_, goal.speed_mps, goal.p_WG - vehicle.p_W);
  if (!predicts_) {
    return velocity_command(limit_, now_us, repulsion(now_us, vehicle), attractive_W);
  }
  const Intent intent{attractive_W, goal.p_WG, ramp_.acceleration_mps2()};
  if (const auto escape_W = escape_.escape(now_us, vehicle, intent, acting_)) {
    return velocity_command(limit_, now_us, *escape_W, Eigen::Vector3d::Zero());
  }
  return velocity_command(limit_, now_us, Eigen::Vector3d::Zero(), attractive_W);
}

Eigen::Vector3d Avoider::repulsion(TimeUs now_us, const VehicleMotion& vehicle) const {
  Eigen::Vector3d repulsive_W = Eigen::Vector3d::Zero();
  for (const TrackedObstacle& tracked : acting_) {
    const Obstacle& obstacle = tracked.obstacle;
    Ellipsoid ellipsoid = tracked.ellipsoid;
    ellipsoid.centre_W += seconds(now_us - obstacle.t_us) * obstacle.v_WO;
    repulsive_W += repulsive_.force(vehicle, ellipsoid, obstacle.v_WO,  // (34)
                                    seconds(now_us - obstacle.last_detection_us));
  }
  return repulsive_W;
}

}  // namespace dodge
