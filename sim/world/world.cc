#include "sim/world/world.h"

#include <cmath>
#include <string>

#include "sim/base/error.h"
#include "sim/base/gravity.h"
#include "sim/base/rotation.h"
#include "sim/world/mujoco_eigen.h"
#include "sim/world/ray.h"

namespace dodgesim {

namespace {

// Where objects wait for their launch: far outside every room.
constexpr double kParkingM = 1000.0;

}  // namespace

World::World(const WorldSpec& spec) : spec_(spec), model_(compose_model(spec)) {
  data_.reset(mj_makeData(model_.get()));
  if (!data_) throw MemoryError("MuJoCo cannot allocate its data.");
  contype_.assign(model_->geom_contype, model_->geom_contype + model_->ngeom);
  conaffinity_.assign(model_->geom_conaffinity, model_->geom_conaffinity + model_->ngeom);
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    const bool moves = model_->body_weldid[model_->geom_bodyid[geom]] != 0;
    if (moves && model_->geom_group[geom] == kRoomGroup) model_->geom_group[geom] = kObjectGroup;
  }
  const ModelReader vehicle(*model_, spec.path(spec.vehicle_file()));
  vehicle_body_ = vehicle.find(mjOBJ_BODY, "vehicle");
  vehicle.override_vehicle(*model_, *data_, spec.vehicle_overrides);
  vehicle_free_ = vehicle.free_body(vehicle_body_);
  vehicle_ = vehicle.vehicle(spec.vehicle_overrides.mass_scale);
  for (int i = 0; i < static_cast<int>(spec.objects.size()); ++i) {
    const ObjectSpec& of = spec.objects[static_cast<std::size_t>(i)];
    const ModelReader object(*model_, spec.path(of.file()));
    object_bodies_.push_back(object.find(mjOBJ_BODY, object_prefix(i) + "body"));
    objects_free_.push_back(object.free_body(object_bodies_.back()));
    objects_.push_back(object.object(object_prefix(i), of.size_m));
  }
  // At last, as the geoms of a body that is not free would seem the room's.
  ModelReader(*model_, spec.path(spec.room_file())).check_room();
  snapshot_.objects.resize(objects_.size());
  snapshot_.launched.resize(objects_.size());
  object_a_W_.resize(objects_.size());
  std::vector<int> moving = {vehicle_body_};
  moving.insert(moving.end(), object_bodies_.begin(), object_bodies_.end());
  contact_bound_.emplace(*model_, moving);
  in_flight_.assign(moving.size(), true);
  reset(Eigen::Vector3d(0, 0, 1), 0, Eigen::Vector3d::Zero());
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

void World::launch(int i, const BodyState& state, bool touches) {
  const auto index = static_cast<std::size_t>(i);
  set_state(objects_free_.at(index), state);
  set_collisions(i, touches);
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
  check_warnings(*data_);
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
  set_quaternion(q, q_W);
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
  set_quaternion(data_->qpos + body.qpos + 3, q_W);
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
