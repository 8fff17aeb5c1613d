#include "sim/world/plausibility.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/world/mujoco_eigen.h"

namespace dodgesim {

namespace {

// A ball has 0.4 times its mass and the square of its radius, the nominal vehicle 0.1.
constexpr double kLeastInertia = 0.0005;

constexpr double kOsmiumKgpm3 = 22590;

constexpr double kMostMount = 3;  // times the vehicle's reach

// Inertia per mass and distance of the rotors from the axis [m]; 0.047 of the nominal vehicle.
constexpr double kMostTurningM = 0.0785;

}  // namespace

double farthest_m(const mjModel& model, int body) {
  double farthest_m = 0;
  const int first = model.body_geomadr[body];
  for (int g = first; g < first + model.body_geomnum[body]; ++g) {
    const double reach_m = ConstMap3(model.geom_pos + 3 * g).norm() + model.geom_rbound[g];
    farthest_m = std::max(farthest_m, reach_m);
  }
  return farthest_m;
}

void check_inertia(const mjModel& model, int body, const std::string& file) {
  const double reach_m = farthest_m(model, body);
  const double most_kgm2 = model.body_mass[body] * reach_m * reach_m;
  const double greatest_kgm2 = ConstMap3(model.body_inertia + 3 * body).maxCoeff();
  if (greatest_kgm2 > most_kgm2) {
    throw ScenarioError(file + formatted(": the body's inertia is %.3g kg m^2, but must be at most "
                                         "%.3g: its mass times the square of how far it reaches.",
                                         greatest_kgm2, most_kgm2));
  }
  if (greatest_kgm2 >= kLeastInertia * most_kgm2) return;
  throw ScenarioError(file + formatted(": the body's greatest moment of inertia is %.3g kg m^2, "
                                       "but must be at least %.3g: %g of its mass times the square "
                                       "of how far it reaches.",
                                       greatest_kgm2, kLeastInertia * most_kgm2, kLeastInertia));
}

void check_density(const mjModel& model, int body, const std::string& file) {
  const double volume_m3 = 4.0 / 3 * std::numbers::pi * std::pow(farthest_m(model, body), 3);
  if (model.body_mass[body] <= kOsmiumKgpm3 * volume_m3) return;
  throw ScenarioError(file + formatted(": the body's mass is %.3g kg, but must be at most %.3g kg: "
                                       "a ball of osmium around it has no more.",
                                       model.body_mass[body], kOsmiumKgpm3 * volume_m3));
}

void check_mounts(const mjModel& model, int body, const VehicleParameters& vehicle,
                  const std::string& file) {
  const double most_m = kMostMount * farthest_m(model, body);
  const auto check = [&](const char* what, const Eigen::Vector3d& p_B) {
    if (p_B.norm() <= most_m) return;
    throw ScenarioError(file + formatted(": %s is %.3g m from the vehicle's centre of mass, but "
                                         "must be within %.3g m: three times as far as its geoms "
                                         "reach.",
                                         what, p_B.norm(), most_m));
  };
  for (const Eigen::Vector3d& rotor : vehicle.rotor_p_B) check("a rotor", rotor);
  for (const Eigen::Isometry3d& camera : vehicle.X_BC) check("a camera", camera.translation());
  check("the range sensor", vehicle.X_BR.translation());
}

void check_turning(const VehicleParameters& vehicle, const std::string& file) {
  for (const int axis : {0, 1}) {
    double lever_m = 0;  // the rotors' mean distance from the axis
    for (const Eigen::Vector3d& rotor : vehicle.rotor_p_B) lever_m += std::abs(rotor[1 - axis]) / 4;
    const double inertia_kgm2 = vehicle.inertia_kgm2[axis];
    const double least_kg = inertia_kgm2 / (kMostTurningM * lever_m);
    if (vehicle.mass_kg >= least_kg) continue;
    throw ScenarioError(
        file + formatted(": the vehicle's mass is %.3g kg, but must be at least %.3g kg for an "
                         "inertia of %.3g kg m^2 about %s and rotors %.3g m from that axis: so "
                         "light a vehicle would climb away when its rotors turn it "
                         "(vehicle_overrides.mass_scale, vehicle_overrides.inertia_scale).",
                         vehicle.mass_kg, least_kg, inertia_kgm2, axis == 0 ? "x" : "y", lever_m));
  }
}

void check_faces(const mjModel& model, int geom, const std::string& file) {
  if (model.geom_type[geom] != mjGEOM_MESH) return;
  const int mesh = model.geom_dataid[geom];
  const auto corner = [&](const int* face, int i) -> Eigen::Vector3d {
    const float* v = model.mesh_vert + 3 * (model.mesh_vertadr[mesh] + face[i]);
    return {v[0], v[1], v[2]};
  };
  double six_volumes_m3 = 0;  // negative inside out
  for (int i = 0; i < model.mesh_facenum[mesh]; ++i) {
    const int* face = model.mesh_face + 3 * (model.mesh_faceadr[mesh] + i);
    six_volumes_m3 += corner(face, 0).dot(corner(face, 1).cross(corner(face, 2)));
  }
  if (six_volumes_m3 >= 0) return;
  const char* name = mj_id2name(&model, mjOBJ_MESH, mesh);
  const std::string known = name == nullptr ? "" : name;
  throw ScenarioError(file + ": the mesh '" + known.substr(known.rfind('/') + 1) +
                      "' is inside out: the corners of its faces must follow each other " +
                      "counter-clockwise as seen from outside.");
}

}  // namespace dodgesim
