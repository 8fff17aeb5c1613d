#include "dodge/avoid/velocity_command.h"

namespace dodge {

VelocityCommand velocity_command(const VelocityLimitConfig& config, TimeUs t_us,
                                 const Eigen::Vector3d& repulsive_W,
                                 const Eigen::Vector3d& attractive_W) {
  VelocityCommand command;
  command.t_us = t_us;
  command.v_W = repulsive_W + attractive_W;
  const double speed = command.v_W.norm();
  if (speed > config.max_speed_mps) command.v_W *= config.max_speed_mps / speed;
  command.evading = repulsive_W.norm() > config.evading_threshold_mps;
  return command;
}

VelocityCommand CommandRamp::ramped(VelocityCommand command, const Eigen::Vector3d& v_WB) {
  if (config_.calm_acceleration_mps2 <= 0) return command;
  if (command.evading) {
    calm_.reset();
    return command;
  }
  const Eigen::Vector3d from_W = calm_ ? calm_->v_W : v_WB;
  const double elapsed_s = calm_ ? seconds(command.t_us - calm_->t_us) : 0;
  const Eigen::Vector3d change_W = command.v_W - from_W;
  const double most_mps = config_.calm_acceleration_mps2 * elapsed_s;
  if (change_W.norm() > most_mps) command.v_W = from_W + most_mps * change_W.normalized();
  calm_ = command;
  return command;
}

}  // namespace dodge
