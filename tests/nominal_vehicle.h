#pragma once

#include <Eigen/Dense>

#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

// The nominal vehicle of the design, without its sensors.
inline VehicleParameters nominal_vehicle() {
  VehicleParameters vehicle;
  vehicle.mass_kg = 1.0;
  vehicle.inertia_kgm2 = Eigen::Vector3d(.0033, .0040, .0062);
  vehicle.rotor_p_B = {Eigen::Vector3d(.085, .10, 0), Eigen::Vector3d(.085, -.10, 0),
                       Eigen::Vector3d(-.085, -.10, 0), Eigen::Vector3d(-.085, .10, 0)};
  vehicle.rotor_spin = {1, -1, 1, -1};
  vehicle.kappa_m = .012;
  vehicle.max_thrust_n = 9.5;
  vehicle.drag_1ps = Eigen::Vector3d(.544, .386, 0);
  vehicle.drag_kh_1pm = .009;
  return vehicle;
}

}  // namespace dodgesim
