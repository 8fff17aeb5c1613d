// The force towards the goal: Falanga et al. 2020, equation (36), the slope of the potential (35).
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

// Force (36), in units of velocity (39).
Eigen::Vector3d attractive_force(const AttractiveConfig& config, double k_a,
                                 const Eigen::Vector3d& e);

}  // namespace dodge
