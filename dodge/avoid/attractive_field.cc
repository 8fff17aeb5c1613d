#include "dodge/avoid/attractive_field.h"

#include <cmath>

namespace dodge {

Eigen::Vector3d attractive_velocity(const AttractiveConfig& config, double speed_mps,
                                    const Eigen::Vector3d& to_goal_W) {
  const double distance_m = to_goal_W.norm();
  if (distance_m >= config.e_0_m) return speed_mps / distance_m * to_goal_W;
  if (distance_m == 0) return Eigen::Vector3d::Zero();
  return speed_mps * std::pow(distance_m / config.e_0_m, config.gamma_a) / distance_m * to_goal_W;
}

}  // namespace dodge
