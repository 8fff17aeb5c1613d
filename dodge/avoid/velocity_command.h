// From virtual forces to the commanded velocity: Falanga et al. 2020, equation (39).
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "dodge/types.h"

namespace dodge {

struct VelocityLimitConfig {
  double max_speed_mps = 5.0;
  double evading_threshold_mps = 0.1;
  double calm_acceleration_mps2 = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("max_speed_mps", max_speed_mps, 0.01, 100.0,
      "Limit of the commanded speed. Needed: (32) asks for 40 m/s on a ball of 10 m/s. With 2 m/s "
      "hardly any throw is dodged.");
    v("evading_threshold_mps", evading_threshold_mps, 0.0, 100.0,
      "The vehicle is evading while the sum of the repulsive forces is larger than this.");
    v("calm_acceleration_mps2", calm_acceleration_mps2, 0.0, 100.0,
      "How fast the command changes while the vehicle does not evade, from the velocity that an "
      "escape leaves it with; 0: at once. Who brakes hard turns fast, and the threshold |w| a + b "
      "hides the next object.");
  }
};

// Sum of the forces as a velocity (39), shortened to the limit; its direction is kept.
VelocityCommand velocity_command(const VelocityLimitConfig& config, TimeUs t_us,
                                 const Eigen::Vector3d& repulsive_W,
                                 const Eigen::Vector3d& attractive_W);

// Lets the command change gently, an extension of the paper: an escape is followed at once, all
// else at calm_acceleration_mps2.
class CommandRamp {
 public:
  explicit CommandRamp(const VelocityLimitConfig& config) : config_(config) {}

  // Call once a cycle. `v_WB` is the vehicle's velocity.
  VelocityCommand ramped(VelocityCommand command, const Eigen::Vector3d& v_WB);

 private:
  VelocityLimitConfig config_;
  std::optional<VelocityCommand> calm_;  // the last command if it was none to evade
};

}  // namespace dodge
