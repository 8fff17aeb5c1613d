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
      "little more than half as many throws are dodged (results/paper/physics.md).");
    v("evading_threshold_mps", evading_threshold_mps, 0.0, 100.0,
      "The vehicle is evading while the sum of the repulsive forces is larger than this.");
    v("calm_acceleration_mps2", calm_acceleration_mps2, 0.0, 100.0,
      "After an escape the command changes at most this fast, from the vehicle's velocity to that "
      "towards the goal; 0: at once. Hard braking tilts the vehicle fast, so that it sees the next "
      "object late. A descent is braked at once: that takes thrust and no tilt.");
  }
};

// Sum (39) of the two virtual forces, which are velocities [m/s], shortened to the limit; its
// direction is kept.
VelocityCommand velocity_command(const VelocityLimitConfig& config, TimeUs t_us,
                                 const Eigen::Vector3d& repulsive_W,
                                 const Eigen::Vector3d& attractive_W);

// Brakes gently after an escape, an extension of the paper: from the vehicle's velocity then on,
// the command changes at calm_acceleration_mps2 until it is the one asked for.
class CommandRamp {
 public:
  explicit CommandRamp(const VelocityLimitConfig& config) : config_(config) {}

  // Call once a cycle. v_WB: the vehicle's velocity [m/s].
  VelocityCommand ramped(VelocityCommand command, const Eigen::Vector3d& v_WB);

  // How fast the next command will change unless it evades [m/s^2]; 0: at once.
  double acceleration_mps2() const { return braking_ ? config_.calm_acceleration_mps2 : 0; }

 private:
  Eigen::Vector3d braked_from(const Eigen::Vector3d& v_WB) const;

  VelocityLimitConfig config_;
  bool braking_ = false;  // an escape has ended, and the command is not yet the one asked for
  std::optional<VelocityCommand> last_;  // the command of the last cycle, if since the escape
};

}  // namespace dodge
