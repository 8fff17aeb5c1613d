#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "sim/control/velocity_controller.h"

namespace dodgesim {

// a_des in B, told from what is commanded to a level vehicle, unless a rate meets its limit: the
// rates turn the rotors towards it, and the thrust is its part along them as they are.
inline Eigen::Vector3d desired_a_B(const RateThrustCommand& command, const Eigen::Vector3d& v_W,
                                   const ControllerSpec& spec, const VehicleParameters& vehicle) {
  const double xy = spec.attitude_gain_xy_1ps, z = spec.attitude_gain_z_1ps;
  const Eigen::Vector3d q_e = 0.5 * command.w_B_radps.cwiseQuotient(Eigen::Vector3d(xy, xy, z));
  const Eigen::Quaterniond q_des_W(std::sqrt(1 - q_e.squaredNorm()), q_e.x(), q_e.y(), q_e.z());
  const Eigen::Vector3d direction = q_des_W * Eigen::Vector3d::UnitZ();
  const double drag_kh_1pm = spec.drag_compensation ? vehicle.drag_kh_1pm : 0;
  const double along_z = command.thrust_mps2 + drag_kh_1pm * v_W.head<2>().squaredNorm();
  return along_z / direction.z() * direction;
}

}  // namespace dodgesim
