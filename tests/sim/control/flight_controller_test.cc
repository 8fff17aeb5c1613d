#include "sim/control/flight_controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

#include "tests/sim/control/closed_loop.h"

namespace dodgesim {
namespace {

// Unit step response of K / (alpha s^2 + (1 + k) s + K).
double second_order_step(double alpha, double torque_gain, double rate_gain, double t_s) {
  const std::complex<double> b = 1 + torque_gain;
  const std::complex<double> root = std::sqrt(b * b - 4 * alpha * rate_gain);
  const std::complex<double> p1 = (-b + root) / (2 * alpha);
  const std::complex<double> p2 = (-b - root) / (2 * alpha);
  return (1.0 + (p2 * std::exp(p1 * t_s) - p1 * std::exp(p2 * t_s)) / (p1 - p2)).real();
}

// Flight controller, motors and body, without the outer loop.
class RateLoop {
 public:
  RateLoop(const FlightControllerSpec& spec, const MotorSpec& motor_spec)
      : body(nominal_vehicle()),
        controller_(spec, nominal_vehicle(), motor_spec),
        motors_(motor_spec, nominal_vehicle().max_thrust_n) {
    controller_.reset(hover_thrusts(nominal_vehicle()));
    motors_.reset(0, hover_thrusts(nominal_vehicle()));
  }

  void tick(const RateThrustCommand& command) {
    motors_.set_command(t_us, controller_.step(t_us, command, body.w_B));
    t_us += kTickUs;
    body.step(motors_.step(t_us), seconds(kTickUs));
  }

  TimeUs t_us = 0;
  RigidBody body;

 private:
  FlightController controller_;
  Motors motors_;
};

MotorSpec without_delay() {
  MotorSpec spec;
  spec.esc_delay_us = 0;
  return spec;
}

TEST(FlightController, HoverCommandGivesHoverThrusts) {
  FlightController controller(FlightControllerSpec(), nominal_vehicle(), MotorSpec());
  controller.reset(hover_thrusts(nominal_vehicle()));
  for (TimeUs t = 0; t < 10000; t += kTickUs) {
    for (double thrust_n : controller.step(t, {Eigen::Vector3d::Zero(), kGravityMps2}, {0, 0, 0})) {
      EXPECT_NEAR(thrust_n, kGravityMps2 / 4, 1e-12);
    }
  }
}

TEST(FlightController, RateStepFollowsTheSecondOrderResponse) {
  FlightControllerSpec spec;
  spec.gyro_filter_s = 0;
  for (int axis = 0; axis < 3; ++axis) {
    RateLoop loop(spec, without_delay());
    const double step_radps = axis == 2 ? 0.2 : 0.5;
    RateThrustCommand command{step_radps * Eigen::Vector3d::Unit(axis), kGravityMps2};
    const double rate_gain = axis == 2 ? spec.rate_gain_z_1ps : spec.rate_gain_xy_1ps;
    const double torque_gain = axis == 2 ? spec.torque_gain_z : spec.torque_gain_xy;
    double worst = 0;
    while (loop.t_us < 600000) {
      loop.tick(command);
      const double predicted =
          second_order_step(spec.motor_time_constant_s, torque_gain, rate_gain, seconds(loop.t_us));
      worst = std::max(worst, std::abs(loop.body.w_B[axis] / step_radps - predicted));
    }
    EXPECT_TRUE(loop.body.finite());
    // The zero-order hold of one tick.
    EXPECT_LT(worst, 0.015) << "axis " << axis;
  }
}

TEST(FlightController, GyroFilterAndDelayCostLittleDamping) {
  RateLoop loop{FlightControllerSpec(), MotorSpec()};
  const RateThrustCommand command{{1, 0, 0}, kGravityMps2};
  double most = 0;
  while (loop.t_us < 500000) {
    loop.tick(command);
    most = std::max(most, loop.body.w_B.x());
  }
  EXPECT_LT(most, 1.15);
  EXPECT_NEAR(loop.body.w_B.x(), 1, 0.005);
}

// The gyroscopic torque is fed forward: a spinning vehicle holds fast rates about all axes.
TEST(FlightController, HoldsRatesAboutSeveralAxesAtOnce) {
  RateLoop loop{FlightControllerSpec(), MotorSpec()};
  const RateThrustCommand command{{5, -4, 1.5}, 15};
  while (loop.t_us < 2000000) loop.tick(command);
  EXPECT_NEAR((loop.body.w_B - command.w_B_radps).norm(), 0, 0.05);
}

TEST(FlightController, ALargeYawStepDoesNotSlowRoll) {
  RateLoop loop{FlightControllerSpec(), MotorSpec()};
  RateLoop without_yaw{FlightControllerSpec(), MotorSpec()};
  for (int n = 0; n < 200; ++n) {
    loop.tick({{12, 0, 7}, 30});
    without_yaw.tick({{12, 0, 0}, 30});
  }
  // The assured yaw torque costs a little.
  EXPECT_NEAR(loop.body.w_B.x(), without_yaw.body.w_B.x(), 0.05 * without_yaw.body.w_B.x());
}

double roll_torque_nm(const std::array<double, 4>& thrust_n) {
  double torque_nm = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    torque_nm += nominal_vehicle().rotor_p_B[k].y() * thrust_n[k];
  }
  return torque_nm;
}

// At every tick, however long the period of the loop.
TEST(FlightController, TheGyroscopeIsLowPassed) {
  FlightControllerSpec spec;
  spec.torque_gain_xy = 0;
  for (const int period_us : {250, 1000}) {
    spec.period_us = period_us;
    FlightController controller(spec, nominal_vehicle(), MotorSpec());
    controller.reset(hover_thrusts(nominal_vehicle()));
    for (TimeUs t = 0; t < 20000; t += kTickUs) {
      const double torque_nm =
          roll_torque_nm(controller.step(t, {{0, 0, 0}, kGravityMps2}, {0.1, 0, 0}));
      if (t % period_us != 0) continue;
      const double filtered = 0.1 * (1 - std::exp(-seconds(t + kTickUs) / spec.gyro_filter_s));
      EXPECT_NEAR(torque_nm, -spec.rate_gain_xy_1ps * 0.0033 * filtered, 1e-12) << t;
    }
  }
}

// It knows at every output what torque motors with that lag have reached since.
TEST(FlightController, FeedsBackTheTorqueOfTheLaggingMotors) {
  FlightControllerSpec spec;
  for (const int period_us : {250, 1000}) {
    spec.period_us = period_us;
    FlightController controller(spec, nominal_vehicle(), MotorSpec());
    controller.reset(hover_thrusts(nominal_vehicle()));
    const double wanted_nm = spec.rate_gain_xy_1ps * 0.0033 * 0.3;
    const double stays = std::exp(-seconds(kTickUs) / spec.motor_time_constant_s);
    double reached_nm = 0;
    for (TimeUs t = 0; t < 40000; t += kTickUs) {
      const double commanded_nm =
          roll_torque_nm(controller.step(t, {{0.3, 0, 0}, kGravityMps2}, {0, 0, 0}));
      if (t % period_us == 0) {
        EXPECT_NEAR(commanded_nm, wanted_nm - spec.torque_gain_xy * reached_nm, 1e-12) << t;
      }
      reached_nm = commanded_nm + stays * (reached_nm - commanded_nm);
    }
  }
}

TEST(FlightController, CommandsChangeOnlyOncePerPeriod) {
  FlightControllerSpec spec;
  spec.period_us = 1000;
  FlightController controller(spec, nominal_vehicle(), MotorSpec());
  controller.reset(hover_thrusts(nominal_vehicle()));
  std::array<double, 4> last{};
  for (TimeUs t = 0; t < 20000; t += kTickUs) {
    const double rate = seconds(t);
    const std::array<double, 4> thrusts =
        controller.step(t, {{1, 0, 0}, kGravityMps2}, {rate, 0, 0});
    if (t > 0) {
      EXPECT_EQ(thrusts == last, t % 1000 != 0);
    }
    last = thrusts;
  }
}

TEST(FlightController, OutputsStayWithinTheLimits) {
  const MotorSpec motors;
  FlightController controller(FlightControllerSpec(), nominal_vehicle(), motors);
  controller.reset(hover_thrusts(nominal_vehicle()));
  RandomStream random(1, 0, "test");
  for (TimeUs t = 0; t < 2000000; t += kTickUs) {
    const RateThrustCommand command{30 * normal_vector<3>(random), random.uniform(-20, 80)};
    for (double thrust_n : controller.step(t, command, 20 * normal_vector<3>(random))) {
      EXPECT_GE(thrust_n, motors.min_thrust_n);
      EXPECT_LE(thrust_n, nominal_vehicle().max_thrust_n);
    }
  }
}

TEST(FlightController, RefusesAPeriodThatIsNoMultipleOfTheTick) {
  FlightControllerSpec spec;
  spec.period_us = 400;
  EXPECT_THROW(FlightController(spec, nominal_vehicle(), MotorSpec()), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim
