// A rigid body with four rotors, written for the tests, flown by the controllers under test.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "sim/base/gravity.h"
#include "sim/control/flight_controller.h"
#include "sim/control/velocity_controller.h"
#include "sim/motors/motors.h"
#include "sim/sensors/state_estimator.h"
#include "tests/nominal_vehicle.h"

namespace dodgesim {

inline constexpr TimeUs kSecondUs = 1000000;

inline std::array<double, 4> hover_thrusts(const VehicleParameters& vehicle) {
  std::array<double, 4> thrusts;
  thrusts.fill(vehicle.mass_kg * kGravityMps2 / 4);
  return thrusts;
}

// Newton-Euler, integrated by a midpoint rule (error far below what the tests ask).
class RigidBody {
 public:
  explicit RigidBody(const VehicleParameters& vehicle) : vehicle_(vehicle) {}

  void step(const std::array<double, 4>& thrust_n, double dt_s) {
    Eigen::Vector3d a_W, dw_B;
    derivatives(thrust_n, q_W, v_W, w_B, a_W, dw_B);
    const Eigen::Quaterniond q_mid = turned(q_W, w_B, 0.5 * dt_s);
    const Eigen::Vector3d v_mid = v_W + 0.5 * dt_s * a_W;
    const Eigen::Vector3d w_mid = w_B + 0.5 * dt_s * dw_B;
    derivatives(thrust_n, q_mid, v_mid, w_mid, a_W, dw_B);
    p_W += dt_s * v_mid;
    q_W = turned(q_W, w_mid, dt_s);
    v_W += dt_s * a_W;
    w_B += dt_s * dw_B;
    this->a_W = a_W;
  }

  bool finite() const { return p_W.allFinite() && v_W.allFinite() && w_B.allFinite(); }
  double tilt_rad() const { return std::acos(std::min(1.0, (q_W * Eigen::Vector3d::UnitZ()).z())); }
  double yaw_rad() const {
    const Eigen::Vector3d x = q_W * Eigen::Vector3d::UnitX();
    return std::atan2(x.y(), x.x());
  }

  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_W = Eigen::Quaterniond::Identity();
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_B = Eigen::Vector3d::Zero();
  Eigen::Vector3d a_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d push_mps2 = Eigen::Vector3d::Zero();  // a disturbance, in W

 private:
  static Eigen::Quaterniond turned(const Eigen::Quaterniond& q, const Eigen::Vector3d& w,
                                   double dt_s) {
    const double angle = w.norm() * dt_s;
    if (angle == 0) return q;
    return (q * Eigen::Quaterniond(Eigen::AngleAxisd(angle, w.normalized()))).normalized();
  }

  void derivatives(const std::array<double, 4>& thrust_n, const Eigen::Quaterniond& q,
                   const Eigen::Vector3d& v, const Eigen::Vector3d& w, Eigen::Vector3d& a,
                   Eigen::Vector3d& dw) const {
    const Eigen::Vector3d v_B = q.conjugate() * v;
    Eigen::Vector3d f_B = -vehicle_.mass_kg * vehicle_.drag_1ps.cwiseProduct(v_B);
    f_B.z() += vehicle_.mass_kg * vehicle_.drag_kh_1pm * v_B.head<2>().squaredNorm();
    Eigen::Vector3d torque = -w.cross(vehicle_.inertia_kgm2.cwiseProduct(w));
    for (std::size_t i = 0; i < 4; ++i) {
      f_B.z() += thrust_n[i];
      torque += vehicle_.rotor_p_B[i].cross(Eigen::Vector3d(0, 0, thrust_n[i]));
      torque.z() += vehicle_.rotor_spin[i] * vehicle_.kappa_m * thrust_n[i];
    }
    a = q * f_B / vehicle_.mass_kg - Eigen::Vector3d(0, 0, kGravityMps2) + push_mps2;
    dw = torque.cwiseQuotient(vehicle_.inertia_kgm2);
  }

  VehicleParameters vehicle_;
};

struct FlightSetup {
  VehicleParameters vehicle = nominal_vehicle();
  ControllerSpec controller;
  FlightControllerSpec flight_controller;
  MotorSpec motors;
  TimeUs state_period_us = 4000;
  TimeUs command_delay_us = 0;                   // estimate to flight controller
  std::optional<StateEstimateSpec> state_error;  // none: the controller sees the truth
  double gyro_sigma_radps = 0;
};

// The whole chain: estimate, velocity controller, delay, flight controller, motors, body.
class Flight {
 public:
  explicit Flight(const FlightSetup& setup)
      : body(setup.vehicle),
        setup_(setup),
        controller(setup.controller, setup.vehicle),
        flight_controller_(setup.flight_controller, setup.vehicle, setup.motors),
        motors_(setup.motors, setup.vehicle.max_thrust_n),
        gyro_noise_(7, 0, "test/gyro") {
    if (setup.state_error) estimator_.emplace(*setup.state_error, 7, 0);
    flight_controller_.reset(hover_thrusts(setup.vehicle));
    motors_.reset(0, hover_thrusts(setup.vehicle));
    command_.thrust_mps2 = kGravityMps2;
  }

  // Flies until `until_us`. `pilot` sees the estimate; `watch` is called after each tick. Fails if
  // the flight diverges: of what is not a number, no test would see that it is too large.
  void fly(
      TimeUs until_us, const std::function<VelocityReference(const StateReading&)>& pilot,
      const std::function<void()>& watch = [] {}) {
    for (; t_us < until_us; t_us += kTickUs) {
      if (t_us % setup_.state_period_us == 0) {
        const StateReading state = estimate();
        sent_.push_back({t_us + setup_.command_delay_us, controller.update(state, pilot(state))});
      }
      while (!sent_.empty() && sent_.front().first <= t_us) {
        command_ = sent_.front().second;
        sent_.pop_front();
      }
      const Eigen::Vector3d gyro =
          body.w_B + setup_.gyro_sigma_radps * normal_vector<3>(gyro_noise_);
      motors_.set_command(t_us, flight_controller_.step(t_us, command_, gyro));
      rotor_thrust_n = motors_.step(t_us + kTickUs);
      body.step(rotor_thrust_n, seconds(kTickUs));
      watch();
    }
    ASSERT_TRUE(body.finite());
  }

  TimeUs t_us = 0;
  RigidBody body;
  std::array<double, 4> rotor_thrust_n{};

 private:
  StateReading estimate() {
    if (!estimator_) return {t_us, body.p_W, body.q_W, body.v_W, body.w_B};
    Snapshot truth;
    truth.t_us = t_us;
    truth.vehicle = {body.p_W, body.q_W, body.v_W, body.q_W * body.w_B};
    return estimator_->sample(truth);
  }

  FlightSetup setup_;

 public:
  VelocityController controller;

 private:
  FlightController flight_controller_;
  Motors motors_;
  std::optional<StateEstimator> estimator_;
  RandomStream gyro_noise_;
  RateThrustCommand command_;
  std::deque<std::pair<TimeUs, RateThrustCommand>> sent_;
};

inline VelocityReference normal(const Eigen::Vector3d& v_W) { return {v_W, false}; }
inline VelocityReference evade(const Eigen::Vector3d& v_W) { return {v_W, true}; }

}  // namespace dodgesim
