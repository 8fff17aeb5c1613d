#include "sim/control/velocity_controller.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/gravity.h"

namespace dodgesim {

namespace {

Eigen::Vector3d clipped(const Eigen::Vector3d& value, const Eigen::Vector3d& limit) {
  return value.cwiseMax(-limit).cwiseMin(limit);
}

Eigen::Vector3d xyz(double xy, double z) { return {xy, xy, z}; }

}  // namespace

VelocityController::VelocityController(const ControllerSpec& spec, const VehicleParameters& vehicle)
    : spec_(spec),
      drag_1ps_(spec.drag_compensation ? vehicle.drag_1ps : Eigen::Vector3d::Zero()),
      drag_kh_1pm_(spec.drag_compensation ? vehicle.drag_kh_1pm : 0),
      max_thrust_mps2_(spec.max_thrust_fraction * 4 * vehicle.max_thrust_n / vehicle.mass_kg),
      max_tilt_tan_(std::tan(spec.max_tilt_deg * std::numbers::pi / 180)) {}

void VelocityController::start(const StateReading& state) {
  const Eigen::Vector3d x_W = state.q_W * Eigen::Vector3d::UnitX();
  yaw_rad_ = std::atan2(x_W.y(), x_W.x());
  p_ref_W_ = state.p_W;
  v_filter_W_ = state.v_W;
  last_us_ = state.t_us;
}

RateThrustCommand VelocityController::update(const StateReading& state,
                                             const VelocityReference& reference) {
  if (!last_us_) start(state);
  const double dt_s = seconds(state.t_us - *last_us_);
  last_us_ = state.t_us;

  const Eigen::Vector3d feedback = reference.evading ? feedback_evading(state, reference.v_W)
                                                     : feedback_normal(state, reference.v_W, dt_s);
  const Eigen::Vector3d drag_W =
      state.q_W * drag_1ps_.cwiseProduct(state.q_W.conjugate() * v_ref_W_);
  const Eigen::Vector3d a_des_W = limited(feedback + Eigen::Vector3d(0, 0, kGravityMps2) + drag_W);

  RateThrustCommand command;
  command.w_B_radps = body_rates(state.q_W, attitude(thrust_direction(a_des_W, reference.evading)));
  const Eigen::Vector3d v_B = state.q_W.conjugate() * state.v_W;
  const double along_z_mps2 = a_des_W.dot(state.q_W * Eigen::Vector3d::UnitZ());
  command.thrust_mps2 = std::clamp(
      std::max(spec_.min_thrust_mps2, along_z_mps2) - drag_kh_1pm_ * v_B.head<2>().squaredNorm(),
      0.0, max_thrust_mps2_);
  return command;
}

Eigen::Vector3d VelocityController::feedback_normal(const StateReading& state,
                                                    const Eigen::Vector3d& v_W, double dt_s) {
  const Eigen::Vector3d a_ref = advance_filter(v_W, dt_s);
  v_ref_W_ = v_filter_W_;
  const Eigen::Vector3d e_p = clipped(p_ref_W_ + dt_s * v_ref_W_ - state.p_W,
                                      xyz(spec_.position_clip_xy_m, spec_.position_clip_z_m));
  p_ref_W_ = state.p_W + e_p;
  const Eigen::Vector3d e_v =
      clipped(v_ref_W_ - state.v_W, xyz(spec_.velocity_clip_xy_mps, spec_.velocity_clip_z_mps));
  return a_ref + xyz(spec_.position_gain_xy_1ps2, spec_.position_gain_z_1ps2).cwiseProduct(e_p) +
         xyz(spec_.velocity_gain_xy_1ps, spec_.velocity_gain_z_1ps).cwiseProduct(e_v);
}

// Moves the filtered command towards v_W; returns the acceleration to feed forward.
Eigen::Vector3d VelocityController::advance_filter(const Eigen::Vector3d& v_W, double dt_s) {
  if (dt_s <= 0) return Eigen::Vector3d::Zero();
  const double stays =
      spec_.velocity_filter_s > 0 ? std::exp(-dt_s / spec_.velocity_filter_s) : 0.0;
  Eigen::Vector3d change = (1 - stays) * (v_W - v_filter_W_);
  const double most = spec_.acceleration_limit_mps2 * dt_s;
  if (change.norm() > most) change *= most / change.norm();
  v_filter_W_ += change;
  if (!spec_.acceleration_feed_forward) return Eigen::Vector3d::Zero();
  return change / dt_s;
}

Eigen::Vector3d VelocityController::feedback_evading(const StateReading& state,
                                                     const Eigen::Vector3d& v_W) {
  const double speed = v_W.norm();
  v_ref_W_ =
      v_W * (speed > spec_.evading_speed_limit_mps ? spec_.evading_speed_limit_mps / speed : 1.0);
  p_ref_W_ = state.p_W;
  v_filter_W_ = state.v_W;
  const Eigen::Vector3d e_v =
      clipped(v_ref_W_ - state.v_W, Eigen::Vector3d::Constant(spec_.evading_velocity_clip_mps));
  return spec_.evading_velocity_gain_1ps * e_v;
}

Eigen::Vector3d VelocityController::limited(const Eigen::Vector3d& a_W) const {
  const Eigen::Vector3d hover(0, 0, kGravityMps2);
  const double lateral = a_W.head<2>().norm();

  // A descent gives way to the tilt limit.
  Eigen::Vector3d a = a_W;
  const double least_z =
      std::max(spec_.min_thrust_mps2, std::min(kGravityMps2, lateral / max_tilt_tan_));
  a.z() = std::max(a.z(), least_z);

  // The largest share s of the acceleration beyond hover with |hover + s extra| <= max thrust.
  const Eigen::Vector3d extra = a - hover;
  if (a.norm() > max_thrust_mps2_ && max_thrust_mps2_ <= kGravityMps2) {
    a *= max_thrust_mps2_ / a.norm();  // it cannot even hover
  } else if (a.norm() > max_thrust_mps2_) {
    const double aa = extra.squaredNorm();
    const double b = extra.dot(hover);
    const double c = hover.squaredNorm() - max_thrust_mps2_ * max_thrust_mps2_;
    const double s = (-b + std::sqrt(std::max(0.0, b * b - aa * c))) / aa;
    a = hover + std::clamp(s, 0.0, 1.0) * extra;
  }

  const double most_lateral = a.z() * max_tilt_tan_;
  const double limited_lateral = a.head<2>().norm();
  if (limited_lateral > most_lateral) a.head<2>() *= most_lateral / limited_lateral;
  return a;
}

// Where the rotors are to point, not normalised: along a_W, but see min_tilt_lift_mps2.
Eigen::Vector3d VelocityController::thrust_direction(const Eigen::Vector3d& a_W,
                                                     bool evading) const {
  if (evading) return a_W;
  return {a_W.x(), a_W.y(), std::max(a_W.z(), spec_.min_tilt_lift_mps2)};
}

Eigen::Quaterniond VelocityController::attitude(const Eigen::Vector3d& a_W) const {
  const Eigen::Vector3d y_C(-std::sin(yaw_rad_), std::cos(yaw_rad_), 0);
  Eigen::Matrix3d R_W;
  R_W.col(2) = a_W.normalized();
  R_W.col(0) = y_C.cross(R_W.col(2)).normalized();
  R_W.col(1) = R_W.col(2).cross(R_W.col(0));
  return Eigen::Quaterniond(R_W);
}

Eigen::Vector3d VelocityController::body_rates(const Eigen::Quaterniond& q_W,
                                               const Eigen::Quaterniond& q_des_W) const {
  const Eigen::Quaterniond q_e = q_W.conjugate() * q_des_W;
  const double sign = q_e.w() < 0 ? -1 : 1;
  const Eigen::Vector3d rates =
      2 * sign * xyz(spec_.attitude_gain_xy_1ps, spec_.attitude_gain_z_1ps).cwiseProduct(q_e.vec());
  return clipped(rates, xyz(spec_.max_rate_xy_radps, spec_.max_rate_z_radps));
}

}  // namespace dodgesim
