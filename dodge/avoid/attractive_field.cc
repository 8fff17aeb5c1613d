#include "dodge/avoid/attractive_field.h"

#include <cmath>

namespace dodge {

double attractive_potential(const AttractiveConfig& config, double k_a, const Eigen::Vector3d& e) {
  const double distance = e.norm(), e_0 = config.e_0_m, gamma_a = config.gamma_a;
  if (distance >= e_0) return k_a * distance;
  const double inner = e_0 / (gamma_a + 1) * std::pow(distance / e_0, gamma_a + 1);
  return k_a * (inner + e_0 * gamma_a / (gamma_a + 1));
}

Eigen::Vector3d attractive_force(const AttractiveConfig& config, double k_a,
                                 const Eigen::Vector3d& e) {
  const double distance = e.norm();
  if (distance >= config.e_0_m) return k_a / distance * e;
  if (distance == 0) return Eigen::Vector3d::Zero();
  return k_a * std::pow(distance / config.e_0_m, config.gamma_a) / distance * e;
}

}  // namespace dodge
