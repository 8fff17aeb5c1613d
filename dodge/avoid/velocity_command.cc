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

}  // namespace dodge
