// What lies along a ray. The vehicle does not count.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "sim/world/compose.h"
#include "sim/world/world.h"

namespace dodgesim {

struct RayHit {
  double distance = 0;  // in lengths of the direction
  int geom = -1;        // id in World::model()
};

// The nearest surface of the geom groups below end_group from p_W along direction_W (of any length
// but zero), if any.
inline std::optional<RayHit> first_along(const World& world, const Eigen::Vector3d& p_W,
                                         const Eigen::Vector3d& direction_W, int end_group) {
  std::array<mjtByte, mjNGROUP> groups{};
  std::fill_n(groups.begin(), end_group, mjtByte{1});
  RayHit hit;
  hit.distance = mj_ray(&world.model(), &world.data(), p_W.data(), direction_W.data(),
                        groups.data(), 1, world.vehicle_body(), &hit.geom);
  if (hit.geom < 0) return std::nullopt;
  return hit;
}

// The nearest surface of the room or of an object that has been thrown.
inline std::optional<RayHit> surface_along(const World& world, const Eigen::Vector3d& p_W,
                                           const Eigen::Vector3d& direction_W) {
  return first_along(world, p_W, direction_W, kFirstHiddenGroup);
}

// The nearest part of the room that a thrown object would meet on this way, seen or not (but for
// geoms with an alpha of 0, which MuJoCo lets rays pass).
inline std::optional<RayHit> obstruction_along(const World& world, const Eigen::Vector3d& p_W,
                                               const Eigen::Vector3d& direction_W) {
  constexpr double kBehind = 1e-6;  // of the length of the direction
  double passed = 0;
  while (auto hit = first_along(world, p_W + passed * direction_W, direction_W, mjNGROUP)) {
    hit->distance += passed;
    const int body = world.model().geom_bodyid[hit->geom];
    if (world.model().body_weldid[body] == 0 && world.can_collide(hit->geom)) return hit;
    passed = hit->distance + kBehind;
  }
  return std::nullopt;
}

// Name of a geom for people; models need not give one.
inline std::string geom_name(const World& world, int geom) {
  const char* name = mj_id2name(&world.model(), mjOBJ_GEOM, geom);
  return name != nullptr && *name != '\0' ? name : "geom " + std::to_string(geom);
}

}  // namespace dodgesim
