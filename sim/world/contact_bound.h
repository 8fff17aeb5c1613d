// Says when nothing can touch anything, so that MuJoCo's search for contacts can be left out: with
// a furnished room it takes three quarters of a tick, and nearly all of a flight is in free air.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <vector>

namespace dodgesim {

// Whether the geom can touch anything, in the model as it is now.
inline bool collides(const mjModel& model, int geom) {
  return model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
}

class ContactBound {
 public:
  // `moving`: the bodies that move, each with a free joint of its own. Only the geoms that can
  // collide in `model` as it is now count.
  ContactBound(const mjModel& model, const std::vector<int>& moving);

  // Whether no two bodies can be in contact with the moving ones at qpos: true only if MuJoCo would
  // find no contact, false near things. Those whose `active` is false touch nothing.
  bool apart(const mjModel& model, const mjtNum* qpos, const std::vector<bool>& active);

 private:
  struct MovingBody {
    int qpos = 0;         // where its position begins
    double radius_m = 0;  // about its origin, of the sphere that encloses what can collide
    // Up to this distance from this place it touches nothing of the room.
    Eigen::Vector3d known_p_W = Eigen::Vector3d::Zero();
    double known_free_m = 0;
  };

  double room_distance(const mjModel& model, const Eigen::Vector3d& p_W) const;

  bool applies_ = true;  // the model has nothing that this class does not know of
  std::vector<MovingBody> moving_;
  struct RoomGeom {
    int geom = 0;
    Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
  };
  std::vector<RoomGeom> room_geoms_;
  double margin_m_ = 0;  // MuJoCo reports contacts from this distance on
};

}  // namespace dodgesim
