#include "sim/world/contact_bound.h"

#include <algorithm>
#include <limits>

#include "sim/base/mujoco.h"
#include "sim/world/mujoco_eigen.h"

namespace dodgesim {

namespace {

// Distance from a point in the geom's frame to a box that encloses the geom.
double box_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& half_size) {
  return (p.cwiseAbs() - half_size).cwiseMax(0).norm();
}

// At most the distance from p_W to a geom that stands at X_WG.
double geom_distance(const mjModel& model, int geom, const Eigen::Isometry3d& X_WG,
                     const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d offset_W = p_W - X_WG.translation();
  const mjtNum* const size = model.geom_size + 3 * geom;
  const auto local = [&] { return Eigen::Vector3d(X_WG.linear().transpose() * offset_W); };
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE:
      return local().z();  // MuJoCo's planes have no edges, and a solid below
    case mjGEOM_SPHERE:
      return offset_W.norm() - size[0];
    case mjGEOM_BOX:
    case mjGEOM_ELLIPSOID:
      return box_distance(local(), {size[0], size[1], size[2]});
    case mjGEOM_CYLINDER:
      return box_distance(local(), {size[0], size[0], size[1]});
    case mjGEOM_CAPSULE:
      return box_distance(local(), {size[0], size[0], size[0] + size[1]});
    default:
      return offset_W.norm() - model.geom_rbound[geom];
  }
}

}  // namespace

ContactBound::ContactBound(const mjModel& model, const std::vector<int>& moving) {
  applies_ = model.npair == 0 && (model.opt.enableflags & mjENBL_OVERRIDE) == 0;
  for (const int body : moving) {
    moving_.push_back({model.jnt_qposadr[model.body_jntadr[body]]});
  }
  const MjDataPtr data(mj_makeData(&model));
  mj_kinematics(&model, data.get());
  for (int g = 0; g < model.ngeom; ++g) {
    if (!collides(model, g)) continue;
    margin_m_ = std::max(margin_m_, model.geom_margin[g]);
    const int body = model.geom_bodyid[g];
    const auto mover = std::ranges::find(moving, body);
    if (mover != moving.end()) {
      double& radius_m = moving_[static_cast<std::size_t>(mover - moving.begin())].radius_m;
      const double reach_m = ConstMap3(model.geom_pos + 3 * g).norm() + model.geom_rbound[g];
      radius_m = std::max(radius_m, reach_m);
    } else {
      room_geoms_.push_back({g, frame(data->geom_xpos + 3 * g, data->geom_xmat + 9 * g)});
      applies_ = applies_ && model.body_weldid[body] == 0;
    }
  }
}

double ContactBound::room_distance(const mjModel& model, const Eigen::Vector3d& p_W) const {
  double distance = std::numeric_limits<double>::infinity();
  for (const RoomGeom& g : room_geoms_) {
    distance = std::min(distance, geom_distance(model, g.geom, g.X_WG, p_W));
  }
  return distance;
}

bool ContactBound::apart(const mjModel& model, const mjtNum* qpos,
                         const std::vector<bool>& active) {
  if (!applies_) return false;
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    if (!active[i]) continue;
    MovingBody& body = moving_[i];
    const ConstMap3 p_W(qpos + body.qpos);
    if (!((p_W - body.known_p_W).norm() < body.known_free_m)) {
      body.known_p_W = p_W;
      body.known_free_m = room_distance(model, p_W) - body.radius_m - margin_m_;
      if (!(body.known_free_m > 0)) return false;
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (!active[k]) continue;
      const double reach_m = body.radius_m + moving_[k].radius_m + margin_m_;
      if (!((p_W - ConstMap3(qpos + moving_[k].qpos)).norm() > reach_m)) return false;
    }
  }
  return true;
}

}  // namespace dodgesim
