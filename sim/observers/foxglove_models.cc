#include "sim/observers/foxglove_models.h"

#include <Eigen/Geometry>
#include <vector>

#include "sim/base/mujoco.h"
#include "sim/world/compose.h"
#include "sim/world/geom_color.h"
#include "sim/world/mujoco_eigen.h"

namespace dodgesim::foxglove {

namespace {

using Eigen::Vector3d;

constexpr double kOutlineM = 0.02;
constexpr double kEndlessM = 20;  // what is shown of a plane without borders, each way

Colour colour_of(const mjModel& model, int geom) {
  return Eigen::Map<const Eigen::Vector4f>(geom_color(model, geom)).cast<double>();
}

Json outline(const Vector3d& p, const Eigen::Quaterniond& q, const mjtNum* half_sides,
             const Colour& colour) {
  const double x = half_sides[0] > 0 ? half_sides[0] : kEndlessM;
  const double y = half_sides[1] > 0 ? half_sides[1] : kEndlessM;
  std::vector<Vector3d> corners = {{x, y, 0}, {-x, y, 0}, {-x, -y, 0}, {x, -y, 0}};
  for (Vector3d& corner : corners) corner = p + q * corner;
  return line(LineKind::kLoop, corners, kOutlineM, colour);
}

Json mesh_triangles(const mjModel& model, int mesh, const Json& pose, const Colour& colour) {
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  const int* faces = model.mesh_face + 3 * model.mesh_faceadr[mesh];
  const int count = 3 * model.mesh_facenum[mesh];
  std::vector<Vector3d> corners;
  corners.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    corners.push_back(Eigen::Map<const Eigen::Vector3f>(vertices + 3 * faces[i]).cast<double>());
  }
  return triangles(pose, corners, colour);
}

void add_geom(const mjModel& model, int geom, const Vector3d& p, const Eigen::Quaterniond& q,
              const Colour& colour, Json& entity) {
  const mjtNum* size = model.geom_size + 3 * geom;
  const Json X = pose(p, q);
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE:
      entity["lines"].push_back(outline(p, q, size, colour));
      break;
    case mjGEOM_SPHERE:
      entity["spheres"].push_back(ellipsoid(X, Vector3d::Constant(2 * size[0]), colour));
      break;
    case mjGEOM_ELLIPSOID:
      entity["spheres"].push_back(ellipsoid(X, 2 * Vector3d(size[0], size[1], size[2]), colour));
      break;
    case mjGEOM_CAPSULE:
      for (const double side : {-1.0, 1.0}) {
        const Json end = pose(p + q * Vector3d(0, 0, side * size[1]), q);
        entity["spheres"].push_back(ellipsoid(end, Vector3d::Constant(2 * size[0]), colour));
      }
      [[fallthrough]];
    case mjGEOM_CYLINDER:
      entity["cylinders"].push_back(cylinder(X, 2 * size[0], 2 * size[1], colour));
      break;
    case mjGEOM_BOX:
      entity["cubes"].push_back(cube(X, 2 * Vector3d(size[0], size[1], size[2]), colour));
      break;
    case mjGEOM_MESH:
      entity["triangles"].push_back(mesh_triangles(model, model.geom_dataid[geom], X, colour));
      break;
    default:
      break;  // nothing that a camera of ours could see either
  }
}

}  // namespace

void add_body(const mjModel& model, int body, const std::optional<Colour>& colour, Json& entity) {
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.geom_bodyid[geom] != body || model.geom_group[geom] > kVehicleGroup) continue;
    add_geom(model, geom, ConstMap3(model.geom_pos + 3 * geom),
             dodgesim::quaternion(model.geom_quat + 4 * geom),
             colour ? *colour : colour_of(model, geom), entity);
  }
}

void add_room(const mjModel& model, const Colour& colour, Json& entity) {
  const MjDataPtr data(mj_makeData(&model));
  mj_kinematics(&model, data.get());
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const bool fixed = model.body_weldid[model.geom_bodyid[geom]] == 0;
    if (!fixed || model.geom_group[geom] > kVehicleGroup) continue;
    const auto X_WG = frame(data->geom_xpos + 3 * geom, data->geom_xmat + 9 * geom);
    add_geom(model, geom, X_WG.translation(), Eigen::Quaterniond(X_WG.linear()), colour, entity);
  }
}

}  // namespace dodgesim::foxglove
