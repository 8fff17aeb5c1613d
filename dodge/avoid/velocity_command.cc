#include "dodge/avoid/velocity_command.h"

#include <algorithm>

namespace dodge {
namespace {

Eigen::Vector3d shortened(const Eigen::Vector3d& v, double limit) {
  const double length = v.norm();
  return length > limit ? limit / length * v : v;
}

}  // namespace

VelocityCommand velocity_command(const VelocityLimitConfig& config, TimeUs t_us,
                                 const Eigen::Vector3d& repulsive_W,
                                 const Eigen::Vector3d& attractive_W) {
  VelocityCommand command;
  command.t_us = t_us;
  command.v_W = shortened(repulsive_W + attractive_W, config.max_speed_mps);
  command.evading = repulsive_W.norm() > config.evading_threshold_mps;
  return command;
}

Eigen::Vector3d CommandRamp::braked_from(const Eigen::Vector3d& v_WB) const {
  return shortened({v_WB.x(), v_WB.y(), std::max(0.0, v_WB.z())}, config_.max_speed_mps);
}

VelocityCommand CommandRamp::ramped(VelocityCommand command, const Eigen::Vector3d& v_WB) {
  if (command.evading) {
    braking_ = config_.calm_acceleration_mps2 > 0;
    last_.reset();
  }
  if (command.evading || !braking_) return command;
  const Eigen::Vector3d from_W = last_ ? last_->v_W : braked_from(v_WB);
  // Not negative, should time go back.
  const double elapsed_s = last_ ? std::max(0.0, seconds(command.t_us - last_->t_us)) : 0;
  const Eigen::Vector3d change_W = command.v_W - from_W;
  const double most_mps = config_.calm_acceleration_mps2 * elapsed_s;
  braking_ = change_W.norm() > most_mps;
  if (braking_) command.v_W = from_W + most_mps * change_W.normalized();
  last_ = command;
  return command;
}

}  // namespace dodge
