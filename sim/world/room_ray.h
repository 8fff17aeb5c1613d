// What of the room lies along a ray. Vehicle and thrown objects do not count.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>

#include "sim/world/compose.h"
#include "sim/world/world.h"

namespace dodgesim {

struct RoomHit {
  double distance = 0;  // in lengths of the direction
  int geom = -1;        // id in World::model()
};

// The nearest surface of the room from p_W along direction_W (of any length but zero), if any.
inline std::optional<RoomHit> room_along(const World& world, const Eigen::Vector3d& p_W,
                                         const Eigen::Vector3d& direction_W) {
  mjtByte room_only[mjNGROUP] = {};
  room_only[kRoomGroup] = 1;
  RoomHit hit;
  hit.distance = mj_ray(&world.model(), &world.data(), p_W.data(), direction_W.data(), room_only, 1,
                        -1, &hit.geom);
  if (hit.geom < 0) return std::nullopt;
  return hit;
}

// Name of a geom for people; models need not give one.
inline std::string geom_name(const World& world, int geom) {
  const char* name = mj_id2name(&world.model(), mjOBJ_GEOM, geom);
  return name != nullptr && *name != '\0' ? name : "geom " + std::to_string(geom);
}

}  // namespace dodgesim
