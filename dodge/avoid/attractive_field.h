// The velocity towards the goal: Falanga et al. 2020, (36), the slope of the potential (35).
#pragma once

#include <Eigen/Dense>

namespace dodge {

struct AttractiveConfig {
  double e_0_m = 0.2;
  double gamma_a = 2.0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("e_0_m", e_0_m, 1e-3, 100.0,
      "Distance to the goal at which the conical field goes over into the polynomial one. Not "
      "given by the paper; first value from the authors' group's open code.");
    v("gamma_a", gamma_a, 0.0, 20.0,
      "How fast the attraction vanishes at the goal; 1: linearly. Same source as e_0_m.");
  }
};

// What the paper calls the attractive force (36), which (39) adds up as a velocity: in W [m/s].
// speed_mps, its k_a, is the cruise speed: from e_0_m outwards the velocity has this length, and
// less nearer the goal. to_goal_W, its e, leads from the vehicle to the goal [m].
Eigen::Vector3d attractive_velocity(const AttractiveConfig& config, double speed_mps,
                                    const Eigen::Vector3d& to_goal_W);

}  // namespace dodge
