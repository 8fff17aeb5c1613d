#include "sim/world/world.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/error.h"
#include "sim/world/room_ray.h"

namespace dodgesim {

namespace {

// Where objects wait for their launch: far outside every room.
constexpr double kParkingM = 1000.0;

using Map3 = Eigen::Map<Eigen::Vector3d>;
using ConstMap3 = Eigen::Map<const Eigen::Vector3d>;

Eigen::Quaterniond quaternion(const mjtNum* q) { return {q[0], q[1], q[2], q[3]}; }

Eigen::Isometry3d pose(const mjtNum* p, const mjtNum* q) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = quaternion(q).toRotationMatrix();
  X.translation() = ConstMap3(p);
  return X;
}

Eigen::Quaterniond rotation(const Eigen::Vector3d& angle_rad) {
  const double angle = angle_rad.norm();
  if (angle < 1e-12) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, angle_rad / angle));
}

}  // namespace

World::World(const WorldSpec& spec)
    : label_(spec.models_dir + "/vehicles/" + spec.vehicle + ".xml"), model_(compose_model(spec)) {
  data_.reset(mj_makeData(model_.get()));
  if (!data_) throw SimulationError("MuJoCo cannot allocate its data.");
  contype_.assign(model_->geom_contype, model_->geom_contype + model_->ngeom);
  conaffinity_.assign(model_->geom_conaffinity, model_->geom_conaffinity + model_->ngeom);
  read_vehicle(spec.vehicle_overrides);
  for (int i = 0; i < static_cast<int>(spec.objects.size()); ++i) {
    label_ =
        spec.models_dir + "/objects/" + spec.objects[static_cast<std::size_t>(i)].kind + ".xml";
    read_object(i);
    if (!spec.air_drag) objects_.back().drag_area_m2 = 0;
  }
  snapshot_.objects.resize(objects_.size());
  snapshot_.launched.resize(objects_.size());
  object_a_W_.resize(objects_.size());
  std::vector<int> moving = {vehicle_body_};
  moving.insert(moving.end(), object_bodies_.begin(), object_bodies_.end());
  contact_bound_.emplace(*model_, moving);
  in_flight_.assign(moving.size(), true);
  reset(Eigen::Vector3d(0, 0, 1), 0, Eigen::Vector3d::Zero());
}

int World::find(mjtObj type, const std::string& name) const {
  const int id = mj_name2id(model_.get(), type, name.c_str());
  if (id < 0) {
    throw ScenarioError(label_ + ": the model has no " + mju_type2Str(type) + " named '" +
                        name.substr(name.rfind('/') + 1) + "'.");
  }
  return id;
}

double World::numeric(const std::string& name, int index, int count) const {
  const int id = find(mjOBJ_NUMERIC, name);
  if (model_->numeric_size[id] != count) {
    throw ScenarioError(label_ + ": the numeric '" + name + "' must have " + std::to_string(count) +
                        " values.");
  }
  return model_->numeric_data[model_->numeric_adr[id] + index];
}

World::FreeBody World::find_free_body(int body) const {
  FreeBody out;
  out.body = body;
  const int joint = model_->body_jntadr[body];
  if (model_->body_jntnum[body] != 1 || model_->jnt_type[joint] != mjJNT_FREE) {
    throw ScenarioError(label_ + ": the body must have a free joint and no other.");
  }
  const int* parents = model_->body_parentid;
  if (std::find(parents, parents + model_->nbody, body) != parents + model_->nbody) {
    throw ScenarioError(label_ + ": the body must have no body within it; it is rigid, and its " +
                        "geoms are its own.");
  }
  if (ConstMap3(model_->body_ipos + 3 * body).norm() > 1e-6) {
    throw ScenarioError(label_ + ": the origin of the body must be its centre of mass.");
  }
  out.qpos = model_->jnt_qposadr[joint];
  out.qvel = model_->jnt_dofadr[joint];
  const Eigen::Matrix3d R = quaternion(model_->body_iquat + 4 * body).toRotationMatrix();
  out.J_kgm2 = R * ConstMap3(model_->body_inertia + 3 * body).asDiagonal() * R.transpose();
  out.J_inv = out.J_kgm2.inverse();
  return out;
}

// Changes the model itself, so that whatever reads it agrees.
void World::override_vehicle(const VehicleOverrides& overrides) {
  model_->body_mass[vehicle_body_] *= overrides.mass_scale;
  for (int axis = 0; axis < 3; ++axis) {
    model_->body_inertia[3 * vehicle_body_ + axis] *= overrides.inertia_scale;
  }
  if (overrides.max_thrust_n > 0) {
    for (int rotor = 0; rotor < model_->nu; ++rotor) {
      model_->actuator_ctrlrange[2 * rotor + 1] = overrides.max_thrust_n;
    }
  }
  if (overrides.stereo_baseline_m > 0) {
    Map3 top(model_->cam_pos + 3 * find(mjOBJ_CAMERA, "top"));
    Map3 bottom(model_->cam_pos + 3 * find(mjOBJ_CAMERA, "bottom"));
    const Eigen::Vector3d middle = 0.5 * (top + bottom);
    const Eigen::Vector3d up = (top - bottom).normalized();
    top = middle + 0.5 * overrides.stereo_baseline_m * up;
    bottom = middle - 0.5 * overrides.stereo_baseline_m * up;
  }
  if (const auto turn = overrides.lower_camera_turn()) {
    // MuJoCo's camera has y up and looks along -z.
    const Eigen::Vector3d axis = Eigen::Vector3d(1, -1, -1).cwiseProduct(turn->axis());
    mjtNum* quat = model_->cam_quat + 4 * find(mjOBJ_CAMERA, "bottom");
    const Eigen::Quaterniond q = quaternion(quat) * Eigen::AngleAxisd(turn->angle(), axis);
    quat[0] = q.w();
    quat[1] = q.x();
    quat[2] = q.y();
    quat[3] = q.z();
  }
  mj_setConst(model_.get(), data_.get());  // what MuJoCo derives from these
}

// The mixer knows four alike, which push along z of B and twist about it.
void World::check_rotor(int site, int actuator) const {
  const mjtNum* gear = model_->actuator_gear + 6 * actuator;
  const Eigen::Vector3d up = quaternion(model_->site_quat + 4 * site) * Eigen::Vector3d::UnitZ();
  const bool plain = model_->actuator_trntype[actuator] == mjTRN_SITE &&
                     model_->actuator_trnid[2 * actuator] == site && up.z() > 1 - 1e-9 &&
                     gear[0] == 0 && gear[1] == 0 && gear[2] == 1 && gear[3] == 0 && gear[4] == 0;
  const bool alike = std::abs(gear[5]) == std::abs(model_->actuator_gear[5]) &&
                     model_->actuator_ctrlrange[2 * actuator + 1] == model_->actuator_ctrlrange[1];
  if (plain && alike) return;
  throw ScenarioError(label_ + ": a rotor must be a motor at its site, with z up, a gear of " +
                      "\"0 0 1 0 0 kappa\", and the kappa (but for its sign) and the ctrlrange " +
                      "of the other rotors.");
}

void World::read_vehicle(const VehicleOverrides& overrides) {
  vehicle_body_ = find(mjOBJ_BODY, "vehicle");
  override_vehicle(overrides);
  vehicle_free_ = find_free_body(vehicle_body_);
  vehicle_.mass_kg = model_->body_mass[vehicle_body_];
  vehicle_.inertia_kgm2 = vehicle_free_.J_kgm2.diagonal();
  if (!vehicle_free_.J_kgm2.isDiagonal(1e-6)) {
    throw ScenarioError(label_ +
                        ": x, y and z of the vehicle must be its principal axes of inertia.");
  }
  for (int k = 0; k < 4; ++k) {
    const std::string name = "rotor_" + std::to_string(k);
    const int site = find(mjOBJ_SITE, name);
    const int actuator = find(mjOBJ_ACTUATOR, name);
    const double torque_m = model_->actuator_gear[6 * actuator + 5];
    if (actuator != k) throw ScenarioError(label_ + ": rotor_0 to rotor_3 must be in this order.");
    check_rotor(site, actuator);
    const auto rotor = static_cast<std::size_t>(k);
    vehicle_.rotor_p_B[rotor] = ConstMap3(model_->site_pos + 3 * site);
    vehicle_.rotor_spin[rotor] = torque_m < 0 ? -1 : 1;
    vehicle_.kappa_m = std::abs(torque_m);
    vehicle_.max_thrust_n = model_->actuator_ctrlrange[2 * actuator + 1];
    vehicle_.drag_1ps[std::min(k, 2)] = numeric("rotor_drag_1ps", std::min(k, 2), 3);
  }
  vehicle_.drag_kh_1pm = numeric("rotor_drag_kh_1pm", 0, 1) / overrides.mass_scale;
  vehicle_.drag_1ps /= overrides.mass_scale;  // accelerations by the same forces
  const double lift = 4 * vehicle_.max_thrust_n / (vehicle_.mass_kg * kGravityMps2);
  if (lift < kLeastLift) {
    throw ScenarioError(label_ + ": the rotors lift only " + std::to_string(lift) +
                        " times the vehicle's weight; it needs at least 1.2 to fly" +
                        " (vehicle_overrides.mass_scale, vehicle_overrides.max_thrust_n).");
  }
  for (const char* name : {"top", "bottom"}) {
    const int camera = find(mjOBJ_CAMERA, name);
    Eigen::Isometry3d X = pose(model_->cam_pos + 3 * camera, model_->cam_quat + 4 * camera);
    // MuJoCo's camera looks along -z with y up; C has z forward and y down.
    X.linear() = X.linear() * Eigen::Vector3d(1, -1, -1).asDiagonal();
    vehicle_.X_BC.push_back(X);
  }
  const int range = find(mjOBJ_SITE, "range");
  vehicle_.X_BR = pose(model_->site_pos + 3 * range, model_->site_quat + 4 * range);
}

void World::read_object(int i) {
  const std::string prefix = object_prefix(i);
  const int body = find(mjOBJ_BODY, prefix + "body");
  ObjectPhysics object;
  object.mass_kg = model_->body_mass[body];
  const int first = model_->body_geomadr[body];
  for (int g = first; g < first + model_->body_geomnum[body]; ++g) {
    const double extent = ConstMap3(model_->geom_pos + 3 * g).norm() + model_->geom_rbound[g];
    object.bounding_radius_m = std::max(object.bounding_radius_m, extent);
  }
  object.drag_area_m2 =
      numeric(prefix + "drag_coefficient", 0, 1) * numeric(prefix + "frontal_area_m2", 0, 1);
  if (!(object.drag_area_m2 >= 0)) {
    throw ScenarioError(label_ + ": drag_coefficient times frontal_area_m2 must not be negative.");
  }
  objects_.push_back(object);
  object_bodies_.push_back(body);
  objects_free_.push_back(find_free_body(body));
}

void World::reset(const Eigen::Vector3d& p_WB, double yaw_rad, const Eigen::Vector3d& v_W) {
  mj_resetData(model_.get(), data_.get());
  BodyState vehicle;
  vehicle.p_W = p_WB;
  vehicle.q_W = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
  vehicle.v_W = v_W;
  set_state(vehicle_free_, vehicle);
  for (int i = 0; i < object_count(); ++i) {
    BodyState parked;
    parked.p_W = Eigen::Vector3d(kParkingM + 10.0 * i, 0, 0);
    set_state(objects_free_[static_cast<std::size_t>(i)], parked);
    set_collisions(i, false);
    snapshot_.launched[static_cast<std::size_t>(i)] = false;
  }
  snapshot_.t_us = 0;
  snapshot_.vehicle_a_W.setZero();
  update_positions();
  fill_snapshot();
}

void World::launch(int i, const BodyState& state) {
  const auto index = static_cast<std::size_t>(i);
  set_state(objects_free_.at(index), state);
  set_collisions(i, true);
  snapshot_.launched[index] = true;
  object_a_W_[index] = Eigen::Vector3d(0, 0, -kGravityMps2);
  update_positions();
  fill_snapshot();
}

std::optional<Overlap> World::overlap(int i) const {
  constexpr double kSinksInM = 1e-3;
  for (int k = 0; k < data_->ncon; ++k) {
    const mjContact& contact = data_->contact[k];
    const bool first = model_->geom_bodyid[contact.geom1] == object_body(i);
    const bool second = model_->geom_bodyid[contact.geom2] == object_body(i);
    if ((!first && !second) || contact.dist > -kSinksInM) continue;
    return Overlap{owner_of(first ? contact.geom2 : contact.geom1), -contact.dist};
  }
  return std::nullopt;
}

std::string World::owner_of(int geom) const {
  const int body = model_->geom_bodyid[geom];
  for (int i = 0; i < object_count(); ++i) {
    if (body == object_body(i)) return "object " + std::to_string(i);
  }
  if (body == vehicle_body_) return "the vehicle";
  return "the room's \"" + geom_name(*this, geom) + "\"";
}

void World::step(const std::array<double, 4>& rotor_thrust_n) {
  for (std::size_t k = 0; k < 4; ++k) {
    if (!std::isfinite(rotor_thrust_n[k])) {
      throw SimulationError("The simulation diverged: the thrust of rotor " + std::to_string(k) +
                            " is not a number at " + std::to_string(data_->time) + " s.");
    }
    data_->ctrl[k] = rotor_thrust_n[k];  // MuJoCo clips to ctrlrange
  }
  apply_drag();
  mj_fwdVelocity(model_.get(), data_.get());
  mj_fwdActuation(model_.get(), data_.get());
  mj_fwdAcceleration(model_.get(), data_.get());
  mj_fwdConstraint(model_.get(), data_.get());
  check_accelerations();
  integrate(vehicle_free_);
  for (std::size_t i = 0; i < objects_free_.size(); ++i) {
    if (snapshot_.launched[i]) integrate(objects_free_[i]);
  }
  mju_copy(data_->qacc_warmstart, data_->qacc, model_->nv);
  snapshot_.t_us += kTickUs;
  data_->time = seconds(snapshot_.t_us);
  update_positions();
  check_simulation(*data_, seconds(snapshot_.t_us));
  snapshot_.vehicle_a_W = ConstMap3(data_->qacc + vehicle_free_.qvel);
  for (std::size_t i = 0; i < objects_free_.size(); ++i) {
    object_a_W_[i] = ConstMap3(data_->qacc + objects_free_[i].qvel);
  }
  fill_snapshot();
}

// Drag is taken at the velocity predicted for the middle of the tick: second order in time.
void World::apply_drag() {
  const double half_tick_s = 0.5 * seconds(kTickUs);
  const BodyState& vehicle = snapshot_.vehicle;
  const Eigen::Vector3d v_B =
      vehicle.q_W.conjugate() * (vehicle.v_W + half_tick_s * snapshot_.vehicle_a_W);
  Eigen::Vector3d a_B = -vehicle_.drag_1ps.cwiseProduct(v_B);
  a_B.z() += vehicle_.drag_kh_1pm * v_B.head<2>().squaredNorm();
  Map3(data_->xfrc_applied + 6 * vehicle_body_) = vehicle_.mass_kg * (vehicle.q_W * a_B);
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (!snapshot_.launched[i]) continue;
    const Eigen::Vector3d v_W = snapshot_.objects[i].v_W + half_tick_s * object_a_W_[i];
    Map3(data_->xfrc_applied + 6 * object_bodies_[i]) =
        -0.5 * kAirDensityKgpm3 * objects_[i].drag_area_m2 * v_W.norm() * v_W;
  }
}

// One tick of a free rigid body: linear acceleration and torque (in the body's frame) are constant
// over the tick. Exact in position; Runge-Kutta of fourth order for Euler's equations.
void World::integrate(const FreeBody& body) {
  const double dt = seconds(kTickUs);
  Map3 p_W(data_->qpos + body.qpos);
  Map3 v_W(data_->qvel + body.qvel);
  const ConstMap3 a_W(data_->qacc + body.qvel);
  p_W += dt * v_W + 0.5 * dt * dt * a_W;
  v_W += dt * a_W;

  Map3 w_B(data_->qvel + body.qvel + 3);
  const Eigen::Vector3d w0 = w_B;
  const Eigen::Vector3d alpha0 = ConstMap3(data_->qacc + body.qvel + 3);
  const Eigen::Vector3d torque = body.J_kgm2 * alpha0 + w0.cross(body.J_kgm2 * w0);
  const auto alpha = [&](const Eigen::Vector3d& w) -> Eigen::Vector3d {
    return body.J_inv * (torque - w.cross(body.J_kgm2 * w));
  };
  const Eigen::Vector3d k2 = alpha(w0 + 0.5 * dt * alpha0);
  const Eigen::Vector3d k3 = alpha(w0 + 0.5 * dt * k2);
  const Eigen::Vector3d k4 = alpha(w0 + dt * k3);
  w_B = w0 + dt / 6.0 * (alpha0 + 2 * k2 + 2 * k3 + k4);

  mjtNum* q = data_->qpos + body.qpos + 3;
  const Eigen::Quaterniond q_W =
      (quaternion(q) * rotation(0.5 * dt * (w0 + Eigen::Vector3d(w_B)))).normalized();
  q[0] = q_W.w();
  q[1] = q_W.x();
  q[2] = q_W.y();
  q[3] = q_W.z();
}

void World::check_accelerations() const {
  for (int k = 0; k < model_->nv; ++k) {
    if (!(std::abs(data_->qacc[k]) < mjMAXVAL)) {
      throw SimulationError("The simulation diverged: an acceleration is not finite at " +
                            std::to_string(data_->time) + " s.");
    }
  }
}

BodyState World::state(const FreeBody& body) const {
  BodyState out;
  out.p_W = ConstMap3(data_->qpos + body.qpos);
  out.q_W = quaternion(data_->qpos + body.qpos + 3);
  out.v_W = ConstMap3(data_->qvel + body.qvel);
  out.w_W = out.q_W * ConstMap3(data_->qvel + body.qvel + 3);
  return out;
}

void World::set_state(const FreeBody& body, const BodyState& state) {
  Map3(data_->qpos + body.qpos) = state.p_W;
  const Eigen::Quaterniond q_W = state.q_W.normalized();
  mjtNum* q = data_->qpos + body.qpos + 3;
  q[0] = q_W.w();
  q[1] = q_W.x();
  q[2] = q_W.y();
  q[3] = q_W.z();
  Map3(data_->qvel + body.qvel) = state.v_W;
  Map3(data_->qvel + body.qvel + 3) = q_W.conjugate() * state.w_W;
}

// Positions, and the contacts there.
void World::update_positions() {
  const bool apart = contact_bound_->apart(*model_, data_->qpos, in_flight_);
  int& disabled = model_->opt.disableflags;
  disabled = apart ? disabled | mjDSBL_CONTACT : disabled & ~mjDSBL_CONTACT;
  mj_fwdPosition(model_.get(), data_.get());
}

void World::set_collisions(int i, bool on) {
  in_flight_[static_cast<std::size_t>(i) + 1] = on;
  const int body = object_body(i);
  const int first = model_->body_geomadr[body];
  for (int g = first; g < first + model_->body_geomnum[body]; ++g) {
    const auto geom = static_cast<std::size_t>(g);
    model_->geom_contype[g] = on ? contype_[geom] : 0;
    model_->geom_conaffinity[g] = on ? conaffinity_[geom] : 0;
  }
}

void World::fill_snapshot() {
  snapshot_.vehicle = state(vehicle_free_);
  for (std::size_t i = 0; i < objects_free_.size(); ++i) {
    snapshot_.objects[i] = state(objects_free_[i]);
  }
}

}  // namespace dodgesim
