#include "sim/control/velocity_controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/sim/control/closed_loop.h"
#include "tests/sim/control/desired_acceleration.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

FlightSetup ideal_setup() {
  FlightSetup setup;
  setup.state_period_us = kTickUs;
  setup.motors.esc_delay_us = 0;
  setup.flight_controller.gyro_filter_s = 0;
  return setup;
}

// The chain linearised about hover, along y: commanded velocity -> filter -> position loop or
// evading gain -> attitude -> body rate -> torque -> motors. Integrated in fine Euler steps.
class LinearChain {
 public:
  explicit LinearChain(const FlightSetup& setup) : s_(setup) {}

  void advance_normal(double v_command_mps, double dt_s) {
    const ControllerSpec& c = s_.controller;
    const double a_ref = (v_command_mps - v_ref_) / c.velocity_filter_s;
    v_ref_ += dt_s * a_ref;
    p_ref_ += dt_s * v_ref_;
    advance(a_ref + c.position_gain_xy_1ps2 * (p_ref_ - p) + c.velocity_gain_xy_1ps * (v_ref_ - v),
            v_ref_, dt_s);
  }

  void advance_evading(double v_command_mps, double dt_s) {
    advance(s_.controller.evading_velocity_gain_1ps * (v_command_mps - v), v_command_mps, dt_s);
  }

  double p = 0;
  double v = 0;

 private:
  void advance(double feedback_mps2, double v_ref_mps, double dt_s) {
    const double drag_1ps = s_.vehicle.drag_1ps.y();
    const double tilt_wanted = (feedback_mps2 + drag_1ps * v_ref_mps) / kGravityMps2;
    const double rate_wanted = s_.controller.attitude_gain_xy_1ps * (tilt_wanted - tilt_);
    const double wanted = s_.flight_controller.rate_gain_xy_1ps * (rate_wanted - rate_) -
                          s_.flight_controller.torque_gain_xy * torque_;
    p += dt_s * v;
    v += dt_s * (kGravityMps2 * tilt_ - drag_1ps * v);
    tilt_ += dt_s * rate_;
    rate_ += dt_s * torque_;
    torque_ += dt_s * (wanted - torque_) / s_.motors.time_constant_up_s;
  }

  FlightSetup s_;
  double v_ref_ = 0, p_ref_ = 0, tilt_ = 0, rate_ = 0, torque_ = 0;
};

// The attractive field of the flight core near its goal (Falanga et al. 2020, eq. 36).
Vector3d attraction(const Vector3d& p_W, const Vector3d& goal_W, double speed_mps) {
  constexpr double kInnerM = 0.2;
  const Vector3d e = goal_W - p_W;
  const double distance = e.norm();
  if (distance == 0) return Vector3d::Zero();
  const double share = distance < kInnerM ? std::pow(distance / kInnerM, 2) : 1.0;
  return speed_mps * share * e / distance;
}

TEST(VelocityController, HoversLevelWithHoverThrustAtAnyHeading) {
  for (double yaw : {-3.0, 0.0, 1.2}) {
    VelocityController controller(ControllerSpec(), nominal_vehicle());
    StateReading state;
    state.q_W = Eigen::AngleAxisd(yaw, Vector3d::UnitZ());
    for (bool evading : {false, true}) {
      const RateThrustCommand command = controller.update(state, {Vector3d::Zero(), evading});
      EXPECT_NEAR(command.thrust_mps2, kGravityMps2, 1e-12);
      EXPECT_NEAR(command.w_B_radps.norm(), 0, 1e-9);
      state.t_us += 4000;
    }
  }
}

TEST(VelocityController, EachAxisOfThePositionLoopHasItsGains) {
  const ControllerSpec spec;
  VelocityController controller(spec, nominal_vehicle());
  StateReading state;
  controller.update(state, {Vector3d::Zero(), false});
  state.t_us = 4000;
  state.p_W = {0.1, -0.2, 0.05};
  state.v_W = {0.3, 0.2, -0.1};
  const Vector3d a_W = desired_a_B(controller.update(state, {Vector3d::Zero(), false}), state.v_W,
                                   spec, nominal_vehicle());
  const double p_xy = spec.position_gain_xy_1ps2, v_xy = spec.velocity_gain_xy_1ps;
  const Vector3d expected(
      -0.1 * p_xy - 0.3 * v_xy, 0.2 * p_xy - 0.2 * v_xy,
      kGravityMps2 - 0.05 * spec.position_gain_z_1ps2 + 0.1 * spec.velocity_gain_z_1ps);
  EXPECT_TRUE(a_W.isApprox(expected, 1e-9)) << a_W.transpose() << ", not " << expected.transpose();
}

TEST(VelocityController, TurnsBackToItsHeadingWithTheYawGain) {
  const ControllerSpec spec;
  VelocityController controller(spec, nominal_vehicle());
  StateReading state;
  controller.update(state, {Vector3d::Zero(), false});
  state.t_us = 4000;
  state.q_W = Eigen::AngleAxisd(0.2, Vector3d::UnitZ());
  const Vector3d w_B = controller.update(state, {Vector3d::Zero(), false}).w_B_radps;
  EXPECT_NEAR(w_B.z(), -2 * spec.attitude_gain_z_1ps * std::sin(0.1), 1e-9);
  EXPECT_NEAR(w_B.head<2>().norm(), 0, 1e-9);
}

TEST(VelocityController, MakesUpForTheRotorsDragUnlessItIsToldNotTo) {
  const auto vehicle = nominal_vehicle();
  StateReading state;
  state.v_W = {4, 0, 0};
  const VelocityReference as_it_flies = {state.v_W, true};
  VelocityController controller(ControllerSpec(), vehicle);
  // Thrust gained in horizontal flight is taken off, and the force against the flight added.
  const RateThrustCommand command = controller.update(state, as_it_flies);
  EXPECT_NEAR(command.thrust_mps2, kGravityMps2 - vehicle.drag_kh_1pm * 16, 1e-12);
  EXPECT_NEAR(desired_a_B(command, state.v_W, ControllerSpec(), vehicle).x(),
              4 * vehicle.drag_1ps.x(), 1e-12);
  ControllerSpec off;
  off.drag_compensation = false;
  VelocityController plain(off, vehicle);
  const RateThrustCommand without = plain.update(state, as_it_flies);
  EXPECT_NEAR(without.thrust_mps2, kGravityMps2, 1e-12);
  EXPECT_NEAR(desired_a_B(without, state.v_W, off, vehicle).x(), 0, 1e-12);
}

TEST(VelocityController, MakesUpForTheDragAlongTheAxesOfATurnedVehicle) {
  const auto vehicle = nominal_vehicle();
  StateReading state;
  state.q_W = Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ());
  state.v_W = {4, 0, 0};  // to its right
  VelocityController controller(ControllerSpec(), vehicle);
  const Vector3d a_W = state.q_W * desired_a_B(controller.update(state, evade(state.v_W)),
                                               state.v_W, ControllerSpec(), vehicle);
  const Vector3d expected(4 * vehicle.drag_1ps.y(), 0, kGravityMps2);
  EXPECT_TRUE(a_W.isApprox(expected, 1e-9)) << a_W.transpose();
}

TEST(VelocityController, BodyRatesTurnTheShortWayTowardsTheDesiredAttitude) {
  VelocityController controller(ControllerSpec(), nominal_vehicle());
  StateReading state;
  controller.update(state, normal(Vector3d::Zero()));
  const double roll = 0.2;
  state.q_W = Eigen::AngleAxisd(roll, Vector3d::UnitX());
  const RateThrustCommand command = controller.update(state, normal(Vector3d::Zero()));
  EXPECT_NEAR(command.w_B_radps.x(), -2 * 12 * std::sin(roll / 2), 1e-9);
  EXPECT_NEAR(command.w_B_radps.tail<2>().norm(), 0, 1e-9);
  EXPECT_NEAR(command.thrust_mps2, kGravityMps2 * std::cos(roll), 1e-9);
  state.q_W.coeffs() *= -1;  // the same attitude
  EXPECT_TRUE(controller.update(state, normal(Vector3d::Zero()))
                  .w_B_radps.isApprox(command.w_B_radps, 1e-9));
}

TEST(VelocityController, SmallEvadingStepFollowsTheLinearPrediction) {
  const FlightSetup setup = ideal_setup();
  constexpr double kStepMps = 0.3;
  Flight flight(setup);
  LinearChain linear(setup);
  double worst = 0;
  flight.fly(
      kSecondUs,
      [&](const StateReading&) {
        return evade({0, kStepMps, 0});
      },
      [&] {
        linear.advance_evading(kStepMps, seconds(kTickUs));
        worst = std::max(worst, std::abs(flight.body.v_W.y() - linear.v));
      });
  EXPECT_LT(worst, 0.03 * kStepMps);
  EXPECT_NEAR(flight.body.v_W.y(), kStepMps, 0.01 * kStepMps);
}

// The step that normal flight makes: 10 m/s^2 at first, so the nonlinearity shows, but little.
TEST(VelocityController, StepOfTwoMetresPerSecondFollowsTheLinearPrediction) {
  const FlightSetup setup = ideal_setup();
  constexpr double kStepMps = 2;
  Flight flight(setup);
  LinearChain linear(setup);
  double worst_v = 0, worst_p = 0, highest = 0, height = 0;
  flight.fly(
      2 * kSecondUs,
      [&](const StateReading&) {
        return normal({0, kStepMps, 0});
      },
      [&] {
        linear.advance_normal(kStepMps, seconds(kTickUs));
        worst_v = std::max(worst_v, std::abs(flight.body.v_W.y() - linear.v));
        worst_p = std::max(worst_p, std::abs(flight.body.p_W.y() - linear.p));
        highest = std::max(highest, flight.body.v_W.y());
        height = std::max(height, std::abs(flight.body.p_W.z()));
      });
  EXPECT_LT(worst_v, 0.07 * kStepMps);
  EXPECT_LT(worst_p, 0.05);
  EXPECT_LT(highest, 1.15 * kStepMps);
  EXPECT_LT(height, 0.05);
  EXPECT_NEAR(flight.body.v_W.y(), kStepMps, 0.01 * kStepMps);
}

TEST(VelocityController, EvadingBypassesFilterAndClips) {
  ControllerSpec spec;
  VelocityController controller(spec, nominal_vehicle());
  StateReading state;
  controller.update(state, normal(Vector3d::Zero()));
  state.t_us = 4000;
  const Vector3d a_W =
      desired_a_B(controller.update(state, evade({0, 3, 0})), state.v_W, spec, nominal_vehicle());
  const double drag_mps2 = 3 * nominal_vehicle().drag_1ps.y();
  EXPECT_NEAR(a_W.y(), 3 * spec.evading_velocity_gain_1ps + drag_mps2, 1e-9);
  EXPECT_NEAR(a_W.z(), kGravityMps2, 1e-9);
}

// As it flies on after an escape at the velocity it has, there is nothing to make up for but drag.
TEST(VelocityController, TakesOverAfterAnEscapeWhereItIsAndAtTheVelocityItHas) {
  const auto vehicle = nominal_vehicle();
  VelocityController controller(ControllerSpec(), vehicle);
  StateReading state;
  controller.update(state, normal(Vector3d::Zero()));
  state = {4000, {0, 0.5, 0}, state.q_W, {0, 4, 0}, {}};
  controller.update(state, evade({0, 5, 0}));
  state = {8000, {0, 0.516, 0}, state.q_W, {0, 4, 0}, {}};
  const Vector3d a_W = desired_a_B(controller.update(state, normal({0, 4, 0})), state.v_W,
                                   ControllerSpec(), vehicle);
  const Vector3d expected(0, 4 * vehicle.drag_1ps.y(), kGravityMps2);
  EXPECT_TRUE(a_W.isApprox(expected, 1e-9)) << a_W.transpose();
}

TEST(VelocityController, HoldsItsPlaceWithinFiveCentimetresUnderStateNoise) {
  FlightSetup setup;
  setup.command_delay_us = 6500;
  setup.state_error = StateEstimateSpec();
  setup.gyro_sigma_radps = 0.03;
  Flight flight(setup);
  double farthest = 0;
  flight.fly(
      60 * kSecondUs,
      [](const StateReading& state) {
        return normal(attraction(state.p_W, {0, 0, 0}, 1.5));
      },
      [&] { farthest = std::max(farthest, flight.body.p_W.norm()); });
  EXPECT_LT(farthest, 0.05);
}

TEST(VelocityController, ReturnsToItsPlaceAfterAPush) {
  const auto stay = [](const StateReading&) { return normal(Vector3d::Zero()); };
  Flight flight{FlightSetup()};
  flight.fly(100000, stay);
  flight.body.v_W = Vector3d(0.5, -0.5, 0.3);
  flight.fly(5 * kSecondUs, stay);
  EXPECT_LT(flight.body.p_W.norm(), 0.02);
  EXPECT_LT(flight.body.v_W.norm(), 0.01);
}

TEST(VelocityController, SettlesAtAGoalWithoutCircling) {
  FlightSetup setup;
  setup.command_delay_us = 6500;
  Flight flight(setup);
  const Vector3d goal(4, 0, 0.5);
  double beyond = 0, fastest = 0, late = 0;
  flight.fly(
      10 * kSecondUs,
      [&](const StateReading& state) { return normal(attraction(state.p_W, goal, 1.5)); },
      [&] {
        beyond = std::max(beyond, flight.body.p_W.x() - goal.x());
        fastest = std::max(fastest, flight.body.v_W.norm());
        if (flight.t_us > 5 * kSecondUs) late = std::max(late, (flight.body.p_W - goal).norm());
      });
  EXPECT_LT(beyond, 0.25);
  EXPECT_LT(fastest, 1.15 * 1.5);
  EXPECT_LT(late, 0.05);
}

}  // namespace
}  // namespace dodgesim
