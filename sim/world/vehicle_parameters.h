// What the world, the flight controller and the motors must know of a vehicle. Read from its MJCF.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

namespace dodgesim {

// The event cameras, by number, as the models name them; the second one may be missing.
inline constexpr std::array<const char*, 2> kCameraNames = {"top", "bottom"};

struct VehicleParameters {
  double mass_kg = 0;
  Eigen::Vector3d inertia_kgm2 = Eigen::Vector3d::Zero();  // diagonal, in B
  // Rotor centres [m]: front left, front right, rear right, rear left. Thrust is along +z_B.
  std::array<Eigen::Vector3d, 4> rotor_p_B;
  std::array<double, 4> rotor_spin{};  // sign of the drag torque on the body about +z_B per thrust
  double kappa_m = 0;                  // drag torque per thrust [m]
  double max_thrust_n = 0;             // of one rotor
  // Rotor drag, mass-normalised: a_B = -drag_1ps * v_B + (0, 0, drag_kh_1pm (v_x^2 + v_y^2)).
  Eigen::Vector3d drag_1ps = Eigen::Vector3d::Zero();
  double drag_kh_1pm = 0;
  std::vector<Eigen::Isometry3d> X_BC;                     // cameras, as kCameraNames
  Eigen::Isometry3d X_BR = Eigen::Isometry3d::Identity();  // range sensor, looking along z
};

}  // namespace dodgesim
