#include "dodge/avoid/attractive_field.h"

#include <cmath>

namespace dodge {

Eigen::Vector3d attractive_force(const AttractiveConfig& config, double k_a,
                                 const Eigen::Vector3d& e) {
  const double distance = e.norm();
  if (distance >= config.e_0_m) return k_a / distance * e;
  if (distance == 0) return Eigen::Vector3d::Zero();
  return k_a * std::pow(distance / config.e_0_m, config.gamma_a) / distance * e;
}

}  // namespace dodge
