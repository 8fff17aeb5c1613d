#include "sim/control/mixer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dodgesim {

Mixer::Mixer(const VehicleParameters& vehicle, double min_thrust_n, double max_thrust_n,
             double assured_yaw_torque_nm)
    : min_thrust_n_(min_thrust_n), max_thrust_n_(max_thrust_n) {
  if (!(min_thrust_n >= 0 && max_thrust_n > min_thrust_n)) {
    throw std::invalid_argument("A rotor's greatest thrust must exceed its least thrust.");
  }
  for (int i = 0; i < 4; ++i) {
    const auto rotor = static_cast<std::size_t>(i);
    const Eigen::Vector3d& p = vehicle.rotor_p_B[rotor];
    allocation_.col(i) << 1, p.y(), -p.x(), vehicle.kappa_m * vehicle.rotor_spin[rotor];
  }
  const Eigen::FullPivLU<Eigen::Matrix4d> lu(allocation_);
  if (!lu.isInvertible()) {
    throw std::invalid_argument("The vehicle's rotors cannot produce every torque.");
  }
  distribution_ = lu.inverse();
  if (distribution_.col(0).minCoeff() <= 0) {
    throw std::invalid_argument(
        "The vehicle's rotors cannot hover: its centre of mass must lie between them, and as many "
        "must turn one way (the sign in their gear) as the other, alternately.");
  }
  assured_yaw_torque_nm_ = std::min(assured_yaw_torque_nm, max_yaw_torque_nm() / 2);
}

std::array<double, 4> Mixer::rotor_thrusts(const Wrench& wanted) const {
  Eigen::Vector4d roll_pitch =
      distribution_.col(1) * wanted.torque_nm.x() + distribution_.col(2) * wanted.torque_nm.y();
  const double yaw_nm =
      feasible_yaw(distribution_.col(0) * wanted.thrust_n + roll_pitch, wanted.torque_nm.z());
  const Eigen::Vector4d yaw = distribution_.col(3) * yaw_nm;
  roll_pitch *= feasible_scale(roll_pitch, yaw);
  const Eigen::Vector4d torques = roll_pitch + yaw;
  const Eigen::Vector4d thrusts =
      torques + distribution_.col(0) * feasible_thrust(torques, wanted.thrust_n);

  std::array<double, 4> result;
  for (int i = 0; i < 4; ++i) {
    // Only rounding is left to clip here.
    result[static_cast<std::size_t>(i)] = std::clamp(thrusts[i], min_thrust_n_, max_thrust_n_);
  }
  return result;
}

Wrench Mixer::wrench(const std::array<double, 4>& rotor_thrust_n) const {
  const Eigen::Vector4d w = allocation_ * Eigen::Vector4d(rotor_thrust_n.data());
  return {w[0], w.tail<3>()};
}

// What the rotors give one way and the other when they do nothing else.
double Mixer::max_yaw_torque_nm() const {
  const auto yaw = allocation_.row(3).array();
  return std::min((yaw * max_thrust_n_).max(yaw * min_thrust_n_).sum(),
                  -(yaw * max_thrust_n_).min(yaw * min_thrust_n_).sum());
}

// The yaw torque nearest to the wanted one that pushes no rotor beyond its limits, but no less than
// the assured amount of it. Rotors that are beyond them without yaw do not count when yaw brings
// them back: less yaw would cost more thrust there.
double Mixer::feasible_yaw(const Eigen::Vector4d& without_yaw, double wanted_nm) const {
  const double sign = wanted_nm < 0 ? -1 : 1;
  double magnitude = std::abs(wanted_nm);
  for (int i = 0; i < 4; ++i) {
    const double per_nm = sign * distribution_(i, 3);
    if (per_nm > 0) {
      magnitude = std::min(magnitude, (max_thrust_n_ - without_yaw[i]) / per_nm);
    } else if (per_nm < 0) {
      magnitude = std::min(magnitude, (min_thrust_n_ - without_yaw[i]) / per_nm);
    }
  }
  const double assured = std::min(std::abs(wanted_nm), assured_yaw_torque_nm_);
  return sign * std::max(magnitude, assured);
}

// The largest s in [0, 1] for which some collective thrust brings s scaled + fixed within the
// limits. With u_i the rotors' shares of thrust, rotors i and j need a thrust T with
// min <= T u_i + s scaled_i + fixed_i and T u_j + s scaled_j + fixed_j <= max.
double Mixer::feasible_scale(const Eigen::Vector4d& scaled, const Eigen::Vector4d& fixed) const {
  const auto share = distribution_.col(0);
  double scale = 1;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double slope = scaled[j] / share[j] - scaled[i] / share[i];
      const double room =
          (max_thrust_n_ - fixed[j]) / share[j] - (min_thrust_n_ - fixed[i]) / share[i];
      if (slope > 0) scale = std::min(scale, room / slope);
    }
  }
  return std::max(scale, 0.0);
}

// The collective thrust nearest to the wanted one for which every rotor is within its limits.
double Mixer::feasible_thrust(const Eigen::Vector4d& torques, double wanted_n) const {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    least = std::max(least, (min_thrust_n_ - torques[i]) / distribution_(i, 0));
    most = std::min(most, (max_thrust_n_ - torques[i]) / distribution_(i, 0));
  }
  return std::max(least, std::min(wanted_n, most));
}

}  // namespace dodgesim
