// The controller on the computer: from a velocity command and the state estimate to collective
// thrust and body rates.
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "sim/control/flight_controller.h"
#include "sim/sensors/readings.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

struct VelocityReference {
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  // [m/s]
  bool evading = false;
};

struct ControllerSpec {
  double velocity_filter_s = 0.2;
  double acceleration_limit_mps2 = 10;
  bool acceleration_feed_forward = true;
  double position_gain_xy_1ps2 = 10;
  double position_gain_z_1ps2 = 15;
  double velocity_gain_xy_1ps = 4;
  double velocity_gain_z_1ps = 6;
  double position_clip_xy_m = 0.6;
  double position_clip_z_m = 0.3;
  double velocity_clip_xy_mps = 1.0;
  double velocity_clip_z_mps = 0.75;
  double evading_velocity_gain_1ps = 8;
  double evading_velocity_clip_mps = 10;
  double evading_speed_limit_mps = 5;
  double attitude_gain_xy_1ps = 12;
  double attitude_gain_z_1ps = 5;
  double max_rate_xy_radps = 14;
  double max_rate_z_radps = 7;
  double max_tilt_deg = 75;
  double min_thrust_mps2 = 1;
  double max_thrust_fraction = 0.9;
  double min_tilt_lift_mps2 = 5;
  bool drag_compensation = true;

  template <class Visitor>
  void visit(Visitor& v) {
    v("velocity_filter_s", velocity_filter_s, 0, 10,
      "Low-pass of the velocity command while not evading, 0 for none; the stock stack's 0.8 s "
      "overshoots a goal by 0.4 m where 0.2 s overshoots by 0.15 m. Below 0.01 s the noise of the "
      "state estimate reaches the rotors by the acceleration that is fed forward: arriving at a "
      "goal, the vehicle shakes, and climbs 1 to 3 m above it.");
    v("acceleration_limit_mps2", acceleration_limit_mps2, 0.1, 10000,
      "Limit on how fast the filtered command changes: a level change of speed tilts the vehicle "
      "by 45 deg.");
    v("acceleration_feed_forward", acceleration_feed_forward,
      "Whether the filtered command's acceleration is fed forward; without it the velocity "
      "overshoots by half and the vehicle circles about its goal.");
    v("position_gain_xy_1ps2", position_gain_xy_1ps2, 0, 1000,
      "Horizontal gain on the position error (rpg_quadrotor_control).");
    v("position_gain_z_1ps2", position_gain_z_1ps2, 0, 1000,
      "Vertical gain on the position error (rpg_quadrotor_control).");
    v("velocity_gain_xy_1ps", velocity_gain_xy_1ps, 0.1, 100,
      "Horizontal gain on the velocity error while not evading (rpg_quadrotor_control).");
    v("velocity_gain_z_1ps", velocity_gain_z_1ps, 0.1, 100,
      "Vertical gain on the velocity error while not evading (rpg_quadrotor_control).");
    v("position_clip_xy_m", position_clip_xy_m, 0, 100,
      "Limit of the position error, per horizontal axis (rpg_quadrotor_control).");
    v("position_clip_z_m", position_clip_z_m, 0, 100,
      "Limit of the vertical position error (rpg_quadrotor_control).");
    v("velocity_clip_xy_mps", velocity_clip_xy_mps, 0, 100,
      "Limit of the velocity error while not evading, per horizontal axis "
      "(rpg_quadrotor_control).");
    v("velocity_clip_z_mps", velocity_clip_z_mps, 0, 100,
      "Limit of the vertical velocity error while not evading (rpg_quadrotor_control).");
    v("evading_velocity_gain_1ps", evading_velocity_gain_1ps, 0.1, 100,
      "Gain on the velocity error while evading, all axes: as fast as the 0.1 s that attitude and "
      "motors need allow, a 5 m/s step overshoots by 2 %.");
    v("evading_velocity_clip_mps", evading_velocity_clip_mps, 0.1, 100,
      "Limit of the velocity error while evading, per axis; wide enough to reverse the fastest "
      "command.");
    v("evading_speed_limit_mps", evading_speed_limit_mps, 0.1, 100,
      "Limit of the commanded speed while evading; 3 m/s and less cannot dodge fast objects. The "
      "pilot's own limit, dodger.velocity_limit.max_speed_mps, must not exceed it.");
    v("attitude_gain_xy_1ps", attitude_gain_xy_1ps, 0.1, 100,
      "Body rate per roll and pitch error (rpg_quadrotor_control).");
    v("attitude_gain_z_1ps", attitude_gain_z_1ps, 0, 100,
      "Body rate per heading error (rpg_quadrotor_control).");
    v("max_rate_xy_radps", max_rate_xy_radps, 0.1, 100,
      "Limit of the commanded roll and pitch rates: Betaflight's 804 deg/s.");
    v("max_rate_z_radps", max_rate_z_radps, 0.1, 100,
      "Limit of the commanded yaw rate: Betaflight's 400 deg/s.");
    v("max_tilt_deg", max_tilt_deg, 1, 85,
      "Limit of the commanded tilt; 75 deg still allows the lateral 33 m/s^2 that "
      "max_thrust_fraction leaves while keeping height.");
    v("min_thrust_mps2", min_thrust_mps2, 0.1, 9,
      "Least collective thrust (rpg_quadrotor_control).");
    v("max_thrust_fraction", max_thrust_fraction, 0.3, 1,
      "Share of the four rotors' greatest thrust that may be commanded; the rest is left to turn "
      "the vehicle.");
    v("min_tilt_lift_mps2", min_tilt_lift_mps2, 0, 9.81,
      "While not evading, the tilt is that for at least this vertical thrust (PX4's "
      "MPC_ACC_DECOUPLE takes gravity's). With 0 a small demand sideways under little thrust turns "
      "the vehicle far: after an escape upward it swings by 60 deg for a second and climbs on.");
    v("drag_compensation", drag_compensation,
      "Whether the rotor drag at the commanded velocity is fed forward, and the thrust that the "
      "rotors gain in level flight taken off.");
  }
};

// The law of rpg_quadrotor_control (Faessler et al.):
//   a_des = Kp clip(p_ref - p) + Kd clip(v_ref - v) + a_ref + g z_W + R D R^T v_ref
//   thrust = max(c_min, a_des . z_B) - k_h (v_x^2 + v_y^2)
//   rates = 2 sgn(q_ew) (k_xy q_ex, k_xy q_ey, k_z q_ez),   q_e = q^-1 q_des
// Not evading, p_ref integrates the low-pass filtered velocity command, which is what holds the
// vehicle in place when the command fades near the goal; it never leaves the estimate by more than
// the clip. Evading, the command bypasses the filter, the position loop is open, and gain and clip
// are their own; p_ref and the filter follow the estimate so that the position loop closes again
// without a jump. The heading is held at that of the first estimate.
//
// When little thrust is wanted while not evading, the tilt is bounded (min_tilt_lift_mps2). When
// the thrust does not suffice, the height has priority: the part of a_des beyond g z_W shrinks,
// keeping its direction. When the tilt limit is met, a commanded descent gives way first (up to
// hover thrust), the lateral acceleration after it.
class VelocityController {
 public:
  VelocityController(const ControllerSpec& spec, const VehicleParameters& vehicle);

  // Call with each new estimate, in the order of their instants; with the same one again when a
  // reference that evades arrives in between.
  RateThrustCommand update(const StateReading& state, const VelocityReference& reference);

  // a_des within the limits of thrust and tilt, gravity included [m/s^2].
  Eigen::Vector3d limited(const Eigen::Vector3d& a_W) const;

 private:
  void start(const StateReading& state);
  Eigen::Vector3d advance_filter(const Eigen::Vector3d& v_W, double dt_s);
  Eigen::Vector3d feedback_normal(const StateReading& state, const Eigen::Vector3d& v_W,
                                  double dt_s);
  Eigen::Vector3d feedback_evading(const StateReading& state, const Eigen::Vector3d& v_W);
  Eigen::Vector3d thrust_direction(const Eigen::Vector3d& a_W, bool evading) const;
  Eigen::Quaterniond attitude(const Eigen::Vector3d& a_W) const;
  Eigen::Vector3d body_rates(const Eigen::Quaterniond& q_W,
                             const Eigen::Quaterniond& q_des_W) const;

  ControllerSpec spec_;
  Eigen::Vector3d drag_1ps_;
  double drag_kh_1pm_;
  double max_thrust_mps2_;
  double max_tilt_tan_;
  std::optional<TimeUs> last_us_;
  double yaw_rad_ = 0;
  Eigen::Vector3d p_ref_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_ref_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_filter_W_ = Eigen::Vector3d::Zero();  // the low-pass of the command
};

}  // namespace dodgesim
