// The force towards the goal: Falanga et al. 2020, equations (35) and (36).
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

// Potential (35) of the error e = goal - vehicle [m], with k_a the desired speed [m/s]. As printed
// it jumps at e_0; the inner branch is raised by k_a e_0 gamma_a / (gamma_a + 1), which leaves (36)
// as it is. The pilot needs the force alone; the tests hold it against this.
double attractive_potential(const AttractiveConfig& config, double k_a, const Eigen::Vector3d& e);

// Force (36), in units of velocity (39).
Eigen::Vector3d attractive_force(const AttractiveConfig& config, double k_a,
                                 const Eigen::Vector3d& e);

}  // namespace dodge
