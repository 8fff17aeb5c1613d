// What the tests of the world share.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "sim/world/world.h"

namespace dodgesim {

inline WorldSpec test_spec(std::vector<ObjectSpec> objects = {{"ball", 0.2}}) {
  WorldSpec spec;
  spec.models_dir = std::string(DODGESIM_SOURCE_DIR) + "/models";
  spec.room = "field";
  spec.objects = std::move(objects);
  return spec;
}

// Thrusts that carry the vehicle's weight.
inline std::array<double, 4> hover(const World& world) {
  const double thrust_n = world.vehicle().mass_kg * kGravityMps2 / 4;
  return {thrust_n, thrust_n, thrust_n, thrust_n};
}

}  // namespace dodgesim
