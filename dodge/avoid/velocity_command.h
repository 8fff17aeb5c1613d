// From virtual forces to the commanded velocity: Falanga et al. 2020, equation (39).
#pragma once

#include <Eigen/Dense>

#include "dodge/types.h"

namespace dodge {

struct VelocityLimitConfig {
  double max_speed_mps = 5.0;
  double evading_threshold_mps = 0.1;

  template <class Visitor>
  void visit(Visitor& v) {
    v("max_speed_mps", max_speed_mps, 0.01, 100.0,
      "Limit of the commanded speed. Needed: (32) asks for 40 m/s on a ball of 10 m/s. With 2 m/s "
      "hardly any throw is dodged.");
    v("evading_threshold_mps", evading_threshold_mps, 0.0, 100.0,
      "The vehicle is evading while the sum of the repulsive forces is larger than this.");
  }
};

// Sum of the forces as a velocity (39), shortened to the limit; its direction is kept.
VelocityCommand velocity_command(const VelocityLimitConfig& config, TimeUs t_us,
                                 const Eigen::Vector3d& repulsive_W,
                                 const Eigen::Vector3d& attractive_W);

}  // namespace dodge
