// What the tests of the world share.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/gravity.h"
#include "sim/world/world.h"
#include "tests/models.h"

namespace dodgesim {

// Where the vehicle starts in the field.
inline const Eigen::Vector3d kStart(0, 0, 5);

inline BodyState thrown(const Eigen::Vector3d& p_W, const Eigen::Vector3d& v_W,
                        const Eigen::Vector3d& w_W = Eigen::Vector3d::Zero()) {
  BodyState state;
  state.p_W = p_W;
  state.v_W = v_W;
  state.w_W = w_W;
  return state;
}

inline WorldSpec test_spec(std::vector<ObjectSpec> objects = {{"ball", 0.2}}) {
  WorldSpec spec;
  spec.models_dir = testing::kModels;
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
