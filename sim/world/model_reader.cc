#include "sim/world/model_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/gravity.h"
#include "sim/base/numbers.h"
#include "sim/world/compose.h"
#include "sim/world/contact_bound.h"
#include "sim/world/convex.h"
#include "sim/world/geom_color.h"
#include "sim/world/mujoco_eigen.h"
#include "sim/world/plausibility.h"

namespace dodgesim {

namespace {

// How far an object reaches from its centre of mass, as multiples of its size: half of it in the
// middle of a ball, the whole at the end of a club. From end to end it is at most as long as a cube
// from corner to corner.
constexpr double kLeastReach = 0.4, kMostReach = 1.2, kMostLength = 1.8;

// The convention of compose.h. What collides must touch all the others.
struct ContactBits {
  const char* of;
  int contype, conaffinity;
};
constexpr std::array<ContactBits, 3> kContactBits = {
    {{"the room", 1, 6}, {"the vehicle", 2, 5}, {"an object", 4, 7}}};
constexpr std::size_t kObjects = 2;

// Torque per thrust of a rotor: those of vehicles have a tenth of this or two.
constexpr double kMostKappaM = 0.1;

struct Extent {
  double reach_m = 0, length_m = 0;
};

// Nearly: of the parts along the edges and diagonals of a cube.
Extent extent_of(const std::vector<Convex>& parts) {
  Extent extent;
  for (const int x : {-1, 0, 1}) {
    for (const int y : {-1, 0, 1}) {
      for (const int z : {-1, 0, 1}) {
        const Eigen::Vector3d along = Eigen::Vector3d(x, y, z).normalized();
        const double ahead_m = reach_m(parts, along), behind_m = reach_m(parts, -along);
        extent.reach_m = std::max(extent.reach_m, ahead_m);
        extent.length_m = std::max(extent.length_m, ahead_m + behind_m);
      }
    }
  }
  return extent;
}

}  // namespace

int ModelReader::find(mjtObj type, const std::string& name) const {
  const int id = mj_name2id(&model_, type, name.c_str());
  if (id < 0) {
    throw ScenarioError(file_ + ": the model has no " + mju_type2Str(type) + " named '" +
                        name.substr(name.rfind('/') + 1) + "'.");
  }
  return id;
}

int ModelReader::find_on_vehicle(mjtObj type, const std::string& name) const {
  const int id = find(type, name);
  const int body = type == mjOBJ_CAMERA ? model_.cam_bodyid[id] : model_.site_bodyid[id];
  if (body == find(mjOBJ_BODY, "vehicle")) return id;
  throw ScenarioError(file_ + ": the " + mju_type2Str(type) + " '" + name +
                      "' must be in the body 'vehicle'.");
}

std::span<const double> ModelReader::numeric(const std::string& name, int count) const {
  const int id = find(mjOBJ_NUMERIC, name);
  if (model_.numeric_size[id] != count) {
    throw ScenarioError(file_ + ": the numeric '" + name + "' must have " + std::to_string(count) +
                        " values.");
  }
  return {model_.numeric_data + model_.numeric_adr[id], static_cast<std::size_t>(count)};
}

void ModelReader::check_contact(int geom) const {
  if (!collides(model_, geom)) return;
  const int body = model_.geom_bodyid[geom], type = model_.geom_contype[geom],
            affinity = model_.geom_conaffinity[geom];
  const std::size_t own = model_.body_weldid[body] == 0         ? 0
                          : body == find(mjOBJ_BODY, "vehicle") ? 1
                                                                : 2;
  for (std::size_t i = 0; i < kContactBits.size(); ++i) {
    const ContactBits& other = kContactBits[i];
    if (i == own) {  // of the kinds there may be several objects only
      if (i != kObjects || (type & affinity) != 0) continue;
    } else if ((type & other.conaffinity) != 0 || (other.contype & affinity) != 0) {
      continue;
    }
    const ContactBits& usual = kContactBits[own];
    throw ScenarioError(
        file_ +
        formatted(": a geom with a contype of %d and a conaffinity of %d would go through "
                  "%s; those of %s have %d and %d, or 0 and 0 if they are for the eye only.",
                  type, affinity, other.of, usual.of, usual.contype, usual.conaffinity));
  }
  if (model_.geom_margin[geom] == model_.geom_gap[geom]) return;
  throw ScenarioError(
      file_ + formatted(": a geom that can collide has a margin of %.3g m and a gap of %.3g m, but "
                        "they must be the same: a smaller gap pushes away what has not touched it "
                        "yet, a greater one lets things sink in.",
                        model_.geom_margin[geom], model_.geom_gap[geom]));
}

// What the cameras see throws back no more light than falls on it, and hides what is behind it.
void ModelReader::check_paint(int geom) const {
  const float* rgba = geom_color(model_, geom);
  if (!is_drawn(model_, geom)) return;
  if (*std::max_element(rgba, rgba + 3) > 1) {
    throw ScenarioError(file_ +
                        ": a geom's colour is above 1: it would throw back more light than " +
                        "falls on it.");
  }
  if (rgba[3] == 1) return;
  throw ScenarioError(file_ + formatted(": a geom's alpha is %g, but must be 1 or, to hide it, 0: "
                                        "nothing is drawn half transparent.",
                                        static_cast<double>(rgba[3])));
}

void ModelReader::check_geom(int geom) const {
  check_contact(geom);
  check_paint(geom);
}

void ModelReader::check_room() const {
  bool stops = false;
  for (int geom = 0; geom < model_.ngeom; ++geom) {
    const int group = model_.geom_group[geom];
    if (model_.body_weldid[model_.geom_bodyid[geom]] != 0) continue;
    check_geom(geom);
    stops = stops || collides(model_, geom);
    if (group == kRoomGroup || group > kVehicleGroup) continue;
    const char* name = mj_id2name(&model_, mjOBJ_GEOM, geom);
    const std::string number = std::to_string(geom);
    throw ScenarioError(file_ + ": the geom " + (name != nullptr ? name : number.c_str()) +
                        " is in group " + std::to_string(group) + "; a room's geoms are in group " +
                        "0, or in 4 or 5 if they are not to be seen.");
  }
  if (stops) return;
  throw ScenarioError(file_ +
                      ": no geom of the room can collide: all would fall through its floor.");
}

FreeBody ModelReader::free_body(int body) const {
  FreeBody out;
  out.body = body;
  const int joint = model_.body_jntadr[body];
  if (model_.body_jntnum[body] != 1 || model_.jnt_type[joint] != mjJNT_FREE) {
    throw ScenarioError(file_ + ": the body must have a free joint and no other.");
  }
  const int* parents = model_.body_parentid;
  if (std::find(parents, parents + model_.nbody, body) != parents + model_.nbody) {
    throw ScenarioError(file_ + ": the body must have no body within it; it is rigid, and its " +
                        "geoms are its own.");
  }
  const int dof = model_.jnt_dofadr[joint];
  if (model_.jnt_stiffness[joint] != 0) {
    throw ScenarioError(file_ + ": the free joint must have no stiffness, which would pull the " +
                        "body back to where the file has it.");
  }
  for (const mjtNum* of_joint :
       {model_.dof_damping, model_.dof_armature, model_.dof_frictionloss}) {
    if (std::any_of(of_joint + dof, of_joint + dof + 6, [](mjtNum v) { return v != 0; })) {
      throw ScenarioError(file_ + ": the free joint must have no damping, armature or " +
                          "frictionloss: nothing but air holds the body back.");
    }
  }
  if (ConstMap3(model_.body_ipos + 3 * body).norm() > 1e-6) {
    throw ScenarioError(file_ + ": the origin of the body must be its centre of mass.");
  }
  const int first = model_.body_geomadr[body];
  for (int g = first; g < first + model_.body_geomnum[body]; ++g) check_geom(g);
  check_inertia(model_, body, file_);
  out.qpos = model_.jnt_qposadr[joint];
  out.qvel = dof;
  const Eigen::Matrix3d R = quaternion(model_.body_iquat + 4 * body).toRotationMatrix();
  out.J_kgm2 = R * ConstMap3(model_.body_inertia + 3 * body).asDiagonal() * R.transpose();
  out.J_inv = out.J_kgm2.inverse();
  return out;
}

void ModelReader::override_vehicle(mjModel& model, mjData& data,
                                   const VehicleOverrides& overrides) const {
  const int body = find(mjOBJ_BODY, "vehicle");
  model.body_mass[body] *= overrides.mass_scale;
  for (int axis = 0; axis < 3; ++axis) {
    model.body_inertia[3 * body + axis] *= overrides.inertia_scale;
  }
  if (overrides.max_thrust_n > 0) {
    for (int rotor = 0; rotor < model.nu; ++rotor) {
      model.actuator_ctrlrange[2 * rotor + 1] = overrides.max_thrust_n;
    }
  }
  if (overrides.stereo_baseline_m > 0) {
    Map3 top(model.cam_pos + 3 * find(mjOBJ_CAMERA, kCameraNames[0]));
    Map3 bottom(model.cam_pos + 3 * find(mjOBJ_CAMERA, kCameraNames[1]));
    const Eigen::Vector3d middle = 0.5 * (top + bottom);
    const Eigen::Vector3d up = (top - bottom).normalized();
    top = middle + 0.5 * overrides.stereo_baseline_m * up;
    bottom = middle - 0.5 * overrides.stereo_baseline_m * up;
  }
  if (const auto turn = overrides.lower_camera_turn()) {
    // MuJoCo's camera has y up and looks along -z.
    const Eigen::Vector3d axis = Eigen::Vector3d(1, -1, -1).cwiseProduct(turn->axis());
    mjtNum* quat = model.cam_quat + 4 * find(mjOBJ_CAMERA, kCameraNames[1]);
    const Eigen::Quaterniond q = quaternion(quat) * Eigen::AngleAxisd(turn->angle(), axis);
    set_quaternion(quat, q);
  }
  mj_setConst(&model, &data);  // what MuJoCo derives from these
}

// The mixer knows four alike, which push along z of B and twist about it.
void ModelReader::check_rotor(int site, int actuator) const {
  const mjtNum* gear = model_.actuator_gear + 6 * actuator;
  const Eigen::Vector3d up = quaternion(model_.site_quat + 4 * site) * Eigen::Vector3d::UnitZ();
  const bool plain = model_.actuator_trntype[actuator] == mjTRN_SITE &&
                     model_.actuator_trnid[2 * actuator] == site && up.z() > 1 - 1e-9 &&
                     gear[0] == 0 && gear[1] == 0 && gear[2] == 1 && gear[3] == 0 && gear[4] == 0;
  // Its force is its control, at once.
  const bool direct = model_.actuator_gaintype[actuator] == mjGAIN_FIXED &&
                      model_.actuator_gainprm[mjNGAIN * actuator] == 1 &&
                      model_.actuator_biastype[actuator] == mjBIAS_NONE &&
                      model_.actuator_dyntype[actuator] == mjDYN_NONE &&
                      !model_.actuator_forcelimited[actuator];
  const bool alike = std::abs(gear[5]) == std::abs(model_.actuator_gear[5]) &&
                     model_.actuator_ctrlrange[2 * actuator] == 0 &&
                     model_.actuator_ctrlrange[1] > 0 && std::abs(gear[5]) <= kMostKappaM &&
                     model_.actuator_ctrlrange[2 * actuator + 1] == model_.actuator_ctrlrange[1];
  if (plain && direct && alike) return;
  throw ScenarioError(
      file_ +
      ": a rotor must be a motor at its site, with z up, a gear of "
      "\"0 0 1 0 0 kappa\" with a kappa of at most " +
      to_text(kMostKappaM) +
      " m, no forcerange, a ctrlrange from 0 to its greatest thrust, and the kappa (but for its "
      "sign) and the ctrlrange of the other rotors.");
}

void ModelReader::read_rotors(VehicleParameters& vehicle) const {
  if (model_.nu != 4) {
    throw ScenarioError(file_ + ": the vehicle must have four actuators, its rotors, not " +
                        std::to_string(model_.nu) + ".");
  }
  for (std::size_t rotor = 0; rotor < 4; ++rotor) {
    const std::string name = "rotor_" + std::to_string(rotor);
    const int site = find_on_vehicle(mjOBJ_SITE, name);
    const int actuator = find(mjOBJ_ACTUATOR, name);
    if (actuator != static_cast<int>(rotor)) {
      throw ScenarioError(file_ + ": rotor_0 to rotor_3 must be in this order.");
    }
    check_rotor(site, actuator);
    const double torque_m = model_.actuator_gear[6 * actuator + 5];
    vehicle.rotor_p_B[rotor] = ConstMap3(model_.site_pos + 3 * site);
    vehicle.rotor_spin[rotor] = torque_m < 0 ? -1 : 1;
    vehicle.kappa_m = std::abs(torque_m);
    vehicle.max_thrust_n = model_.actuator_ctrlrange[2 * actuator + 1];
  }
}

VehicleParameters ModelReader::vehicle(double mass_scale) const {
  VehicleParameters vehicle;
  const int body = find(mjOBJ_BODY, "vehicle");
  const Eigen::Matrix3d J_kgm2 = free_body(body).J_kgm2;
  if (!J_kgm2.isDiagonal(1e-6)) {
    throw ScenarioError(file_ +
                        ": x, y and z of the vehicle must be its principal axes of inertia.");
  }
  vehicle.mass_kg = model_.body_mass[body];
  vehicle.inertia_kgm2 = J_kgm2.diagonal();
  read_rotors(vehicle);
  // Accelerations by the same forces as at the model's own mass.
  vehicle.drag_1ps = ConstMap3(numeric("rotor_drag_1ps", 3).data()) / mass_scale;
  vehicle.drag_kh_1pm = numeric("rotor_drag_kh_1pm", 1)[0] / mass_scale;
  if (!(vehicle.drag_1ps.minCoeff() >= 0 && vehicle.drag_kh_1pm >= 0)) {
    throw ScenarioError(file_ + ": rotor_drag_1ps and rotor_drag_kh_1pm must not be negative.");
  }
  const double lift = 4 * vehicle.max_thrust_n / (vehicle.mass_kg * kGravityMps2);
  if (lift < kLeastLift) {
    throw ScenarioError(file_ + ": the rotors lift only " + std::to_string(lift) +
                        " times the vehicle's weight; it needs at least " + to_text(kLeastLift) +
                        " to fly (vehicle_overrides.mass_scale, vehicle_overrides.max_thrust_n).");
  }
  for (const char* name : kCameraNames) {
    const bool needed = vehicle.X_BC.empty();
    if (!needed && mj_name2id(&model_, mjOBJ_CAMERA, name) < 0) continue;
    const int camera = find_on_vehicle(mjOBJ_CAMERA, name);
    Eigen::Isometry3d X = pose(model_.cam_pos + 3 * camera, model_.cam_quat + 4 * camera);
    // MuJoCo's camera looks along -z with y up; C has z forward and y down.
    X.linear() = X.linear() * Eigen::Vector3d(1, -1, -1).asDiagonal();
    vehicle.X_BC.push_back(X);
  }
  const int range = find_on_vehicle(mjOBJ_SITE, "range");
  vehicle.X_BR = pose(model_.site_pos + 3 * range, model_.site_quat + 4 * range);
  if (vehicle.X_BR.linear()(2, 2) > -1 + 1e-9) {  // the pilot takes it for granted
    throw ScenarioError(file_ + ": the range sensor must look down: z of its site, 'range', is " +
                        "its line of sight and must be -z of the body.");
  }
  check_mounts(model_, body, vehicle, file_);
  check_turning(vehicle, file_);
  return vehicle;
}

void ModelReader::check_reach(int body, double size_m, const char* which,
                              bool (*wanted)(const mjModel& model, int geom)) const {
  const std::vector<Convex> parts =
      convex_parts(model_, body, file_, [&](int geom) { return wanted(model_, geom); });
  if (parts.empty()) return;
  const auto [reach_m, length_m] = extent_of(parts);
  if (reach_m <= kLeastReach * size_m || reach_m >= kMostReach * size_m) {
    throw ScenarioError(
        file_ +
        formatted(": with a size of %.3g m its geoms that %s reach %.3g m from its centre of mass, "
                  "but must reach %.3g to %.3g m: reference_size_m is the longest extension of "
                  "the model.",
                  size_m, which, reach_m, kLeastReach * size_m, kMostReach * size_m));
  }
  if (length_m < kMostLength * size_m) return;
  throw ScenarioError(
      file_ + formatted(": with a size of %.3g m its geoms that %s are %.3g m long from end to "
                        "end: reference_size_m is the longest extension of the model, a ball's "
                        "diameter.",
                        size_m, which, length_m));
}

ObjectPhysics ModelReader::object(const std::string& prefix, double size_m) const {
  const int body = find(mjOBJ_BODY, prefix + "body");
  ObjectPhysics object;
  object.mass_kg = model_.body_mass[body];
  object.bounding_radius_m = farthest_m(model_, body);
  check_reach(body, size_m, "collide", collides);
  check_reach(body, size_m, "are seen", is_drawn);
  check_density(model_, body, file_);
  for (int g = 0; g < model_.body_geomnum[body]; ++g) {
    check_faces(model_, model_.body_geomadr[body] + g, file_);
  }
  object.drag_area_m2 =
      numeric(prefix + "drag_coefficient", 1)[0] * numeric(prefix + "frontal_area_m2", 1)[0];
  if (!(object.drag_area_m2 >= 0)) {
    throw ScenarioError(file_ + ": drag_coefficient times frontal_area_m2 must not be negative.");
  }
  return object;
}

}  // namespace dodgesim
