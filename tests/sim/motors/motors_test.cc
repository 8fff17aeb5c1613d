#include "sim/motors/motors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "sim/base/random.h"

namespace dodgesim {
namespace {

constexpr double kMaxThrustN = 9.5;

std::array<double, 4> all(double thrust_n) { return {thrust_n, thrust_n, thrust_n, thrust_n}; }

TEST(Motors, SteadyThrustStays) {
  Motors motors(MotorSpec(), kMaxThrustN);
  motors.reset(0, all(2.45));
  for (TimeUs t = kTickUs; t <= 100000; t += kTickUs) EXPECT_DOUBLE_EQ(motors.step(t)[2], 2.45);
}

TEST(Motors, StepsFollowTheExponentialUpAndDownFromTheInstantTheCommandActs) {
  MotorSpec spec;
  spec.time_constant_up_s = 0.048;
  spec.time_constant_down_s = 0.061;
  Motors motors(spec, kMaxThrustN);
  motors.reset(0, all(3));
  motors.set_command(0, {6, 1, 3, 6});
  for (TimeUs t = kTickUs; t <= 200000; t += kTickUs) {
    const std::array<double, 4>& thrust = motors.step(t);
    const double since_s = seconds(t - spec.esc_delay_us);
    EXPECT_NEAR(thrust[0], 6 - 3 * std::exp(-since_s / 0.048), 1e-12);
    EXPECT_NEAR(thrust[1], 1 + 2 * std::exp(-since_s / 0.061), 1e-12);
    EXPECT_DOUBLE_EQ(thrust[2], 3);
  }
}

TEST(Motors, CommandHasNoEffectBeforeTheDelayHasPassed) {
  MotorSpec spec;
  spec.esc_delay_us = 1100;
  Motors motors(spec, kMaxThrustN);
  motors.reset(0, all(3));
  motors.set_command(0, all(6));
  for (TimeUs t = kTickUs; t <= 1000; t += kTickUs) EXPECT_DOUBLE_EQ(motors.step(t)[0], 3);
  EXPECT_NEAR(motors.step(1250)[0], 6 - 3 * std::exp(-150e-6 / spec.time_constant_up_s), 1e-12);
}

// The last of several commands under way must not overtake the earlier ones, whatever the step.
TEST(Motors, ThrustDoesNotDependOnHowOftenItIsRead) {
  MotorSpec spec;
  spec.esc_delay_us = 3300;
  Motors often(spec, kMaxThrustN);
  Motors seldom(spec, kMaxThrustN);
  often.reset(0, all(3));
  seldom.reset(0, all(3));
  RandomStream random(1, 0, "test");
  for (TimeUs t = 0; t < 200000; t += kTickUs) {
    const double thrust_n = random.uniform(0, 9);
    often.set_command(t, all(thrust_n));
    seldom.set_command(t, all(thrust_n));
    const double fine = often.step(t + kTickUs)[0];
    if ((t + kTickUs) % 10000 == 0) {
      EXPECT_NEAR(seldom.step(t + kTickUs)[0], fine, 1e-10);
    }
  }
}

TEST(Motors, ThrustStaysWithinItsLimits) {
  const double kMinThrustN = MotorSpec().min_thrust_n;
  Motors motors(MotorSpec(), kMaxThrustN);
  motors.reset(0, all(-1));
  RandomStream random(2, 0, "test");
  for (TimeUs t = 0; t < 1000000; t += kTickUs) {
    motors.set_command(t, {random.uniform(-50, 50), -100, 100, random.uniform(0, 12)});
    for (double thrust_n : motors.step(t + kTickUs)) {
      EXPECT_GE(thrust_n, kMinThrustN);
      EXPECT_LE(thrust_n, kMaxThrustN);
    }
  }
  EXPECT_NEAR(motors.step(1000000)[1], kMinThrustN, 1e-9);
  EXPECT_NEAR(motors.step(1000000)[2], kMaxThrustN, 1e-9);
}

TEST(Motors, ResetForgetsCommandsUnderWay) {
  Motors motors(MotorSpec(), kMaxThrustN);
  motors.set_command(0, all(9));
  motors.reset(0, all(2));
  EXPECT_DOUBLE_EQ(motors.step(10000)[0], 2);
}

TEST(Motors, RefusesAMaximumBelowTheMinimum) {
  EXPECT_THROW(Motors(MotorSpec(), 0.05), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim
