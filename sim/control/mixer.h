// From collective thrust and torque to four rotor thrusts, and what gives way when they saturate.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

struct Wrench {
  double thrust_n = 0;                                  // along +z of B
  Eigen::Vector3d torque_nm = Eigen::Vector3d::Zero();  // in B
};

// Works for any four rotors whose thrusts span thrust and torques. Saturation as in Faessler et al.
// 2017 ("Thrust mixing, saturation, and body-rate control for accurate aggressive quadrotor
// flight"): roll and pitch come before collective thrust, thrust before yaw. First the yaw torque
// shrinks, down to an assured amount; then the collective thrust shifts. Where even that is not
// enough, roll and pitch shrink together, which keeps their axis (the paper clips each rotor).
class Mixer {
 public:
  // assured_yaw_torque_nm: the yaw torque that is given up last; half of the greatest if that is
  // less, as roll and pitch would lose theirs otherwise. Throws std::invalid_argument when
  // the rotors cannot produce all torques, or not min_thrust_n < max_thrust_n.
  Mixer(const VehicleParameters& vehicle, double min_thrust_n, double max_thrust_n,
        double assured_yaw_torque_nm);

  // Rotor thrusts [N], each within [min_thrust_n, max_thrust_n].
  std::array<double, 4> rotor_thrusts(const Wrench& wanted) const;

  // The wrench that rotor thrusts produce.
  Wrench wrench(const std::array<double, 4>& rotor_thrust_n) const;

 private:
  double max_yaw_torque_nm() const;
  double feasible_yaw(const Eigen::Vector4d& without_yaw, double wanted_nm) const;
  double feasible_scale(const Eigen::Vector4d& scaled, const Eigen::Vector4d& fixed) const;
  double feasible_thrust(const Eigen::Vector4d& torques, double wanted_n) const;

  Eigen::Matrix4d allocation_;    // rotor thrusts -> (thrust, torques)
  Eigen::Matrix4d distribution_;  // its inverse
  double min_thrust_n_;
  double max_thrust_n_;
  double assured_yaw_torque_nm_;
};

}  // namespace dodgesim
