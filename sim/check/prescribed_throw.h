// A random throw past a vehicle that moves as it is told: both with constant velocities.
#pragma once

#include <cstdint>

#include "sim/world/snapshot.h"
#include "sim/world/world.h"

namespace dodgesim {

struct PrescribedThrow {
  double size_m = 0.2;
  double yaw_rad = 0;  // of the vehicle at first, which is level
  BodyState vehicle, object;

  // Half of them turn at 5 rad/s, half of the objects come into view from the side.
  static PrescribedThrow random(std::uint64_t seed, int number, const Eigen::Isometry3d& X_BC);

  // Vehicle and object at t_us.
  Snapshot at(TimeUs t_us) const;
};

}  // namespace dodgesim
