// What the velocity controller never asks of the vehicle.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/control/velocity_controller.h"
#include "tests/sim/control/closed_loop.h"
#include "tests/sim/control/desired_acceleration.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

const Vector3d kHover(0, 0, kGravityMps2);

TEST(VelocityControllerLimits, ThePositionReferenceNeverLeavesTheEstimateByMoreThanTheClip) {
  const ControllerSpec spec;
  VelocityController controller(spec, nominal_vehicle());
  StateReading state;
  controller.update(state, normal(Vector3d::Zero()));
  const Vector3d clip_m(spec.position_clip_xy_m, spec.position_clip_xy_m, spec.position_clip_z_m);
  const Vector3d most_mps2 = clip_m.cwiseProduct(
      Vector3d(spec.position_gain_xy_1ps2, spec.position_gain_xy_1ps2, spec.position_gain_z_1ps2));
  // Moved far away, and then by as much as brings the reference to the other side of it.
  const Vector3d signs(1, -1, 1);
  Vector3d error = -signs;
  for (const Vector3d& step_m :
       {Vector3d(100 * signs), Vector3d(-2 * signs.cwiseProduct(clip_m))}) {
    state.t_us += 4000;
    state.p_W += step_m;
    const Vector3d a_W = desired_a_B(controller.update(state, normal(Vector3d::Zero())),
                                     Vector3d::Zero(), spec, nominal_vehicle());
    const Vector3d expected = error.cwiseProduct(most_mps2) + Vector3d(0, 0, kGravityMps2);
    EXPECT_TRUE(a_W.isApprox(expected, 1e-9)) << a_W.transpose();
    error = signs;
  }
}

TEST(VelocityControllerLimits, CommandedSpeedIsLimitedWhileEvading) {
  ControllerSpec spec;
  VelocityController limited(spec, nominal_vehicle());
  VelocityController within(spec, nominal_vehicle());
  const Vector3d direction = Vector3d(1, 2, 2) / 3;
  const auto command = limited.update(StateReading(), evade(40 * direction));
  const auto expected =
      within.update(StateReading(), evade(spec.evading_speed_limit_mps * direction));
  EXPECT_TRUE(command.w_B_radps.isApprox(expected.w_B_radps, 1e-12));
  EXPECT_NEAR(command.thrust_mps2, expected.thrust_mps2, 1e-12);
}

TEST(VelocityControllerLimits, WithoutThrustToSpareHeightComesFirstAndTheDirectionIsKept) {
  const ControllerSpec spec;
  const VelocityController controller(spec, nominal_vehicle());
  const double most_mps2 = spec.max_thrust_fraction * 4 * 9.5 / 1.0;
  const Vector3d extra(30, 40, 20);
  const Vector3d a = controller.limited(kHover + extra);
  EXPECT_NEAR(a.norm(), most_mps2, 1e-9);
  EXPECT_NEAR((a - kHover).normalized().dot(extra.normalized()), 1, 1e-12);

  const Vector3d lateral = controller.limited(kHover + Vector3d(100, 0, 0));
  EXPECT_NEAR(lateral.z(), kGravityMps2, 1e-9);
  EXPECT_NEAR(lateral.x(), std::sqrt(most_mps2 * most_mps2 - kGravityMps2 * kGravityMps2), 1e-9);
}

TEST(VelocityControllerLimits, WithoutThrustToHoverItGivesAllItHas) {
  ControllerSpec spec;
  spec.max_thrust_fraction = 0.2;
  const VelocityController controller(spec, nominal_vehicle());
  const double most_mps2 = spec.max_thrust_fraction * 4 * 9.5 / 1.0;
  ASSERT_LT(most_mps2, kGravityMps2);
  EXPECT_TRUE(controller.limited(kHover).isApprox(most_mps2 * Vector3d::UnitZ()));
  const Vector3d a = controller.limited(kHover + Vector3d(2, 0, 0));
  EXPECT_NEAR(a.norm(), most_mps2, 1e-9);
}

TEST(VelocityControllerLimits, DescentGivesWayBeforeLateralAccelerationAtTheTiltLimit) {
  ControllerSpec spec;
  spec.max_tilt_deg = 60;
  const VelocityController controller(spec, nominal_vehicle());
  const double tan_tilt = std::tan(spec.max_tilt_deg * std::numbers::pi / 180);
  const Vector3d within = controller.limited({10, 0, -20});
  EXPECT_NEAR(within.x(), 10, 1e-9);
  EXPECT_NEAR(within.z(), 10 / tan_tilt, 1e-9);
  const Vector3d beyond = controller.limited({25, 0, -20});
  EXPECT_NEAR(beyond.z(), kGravityMps2, 1e-9);
  EXPECT_NEAR(beyond.x(), kGravityMps2 * tan_tilt, 1e-9);
  const Vector3d down = controller.limited({0, 0, -20});
  EXPECT_NEAR(down.z(), spec.min_thrust_mps2, 1e-9);
}

TEST(VelocityControllerLimits, LimitsHoldForAnyStateAndCommand) {
  const ControllerSpec spec;
  VelocityController controller(spec, nominal_vehicle());
  const double most_mps2 = spec.max_thrust_fraction * 4 * nominal_vehicle().max_thrust_n;
  const double least_cos = std::cos(spec.max_tilt_deg * std::numbers::pi / 180);
  RandomStream random(1, 0, "test");
  StateReading state;
  for (int n = 0; n < 20000; ++n) {
    state.t_us += 4000;
    state.p_W += normal_vector<3>(random);
    state.v_W = 6 * normal_vector<3>(random);
    state.q_W.coeffs() = normal_vector<4>(random).normalized();
    const RateThrustCommand command =
        controller.update(state, {8 * normal_vector<3>(random), random.uniform() < 0.5});
    EXPECT_TRUE(command.w_B_radps.allFinite());
    EXPECT_GE(command.thrust_mps2, 0);
    EXPECT_LE(command.thrust_mps2, most_mps2 + 1e-9);
    EXPECT_LE(command.w_B_radps.head<2>().cwiseAbs().maxCoeff(), spec.max_rate_xy_radps);
    EXPECT_LE(std::abs(command.w_B_radps.z()), spec.max_rate_z_radps);
    const Vector3d a = controller.limited(40 * normal_vector<3>(random));
    EXPECT_LE(a.norm(), most_mps2 + 1e-9);
    EXPECT_GE(a.z() / a.norm(), least_cos - 1e-9);
  }
}

TEST(VelocityControllerLimits, TheFilteredCommandChangesNoFasterThanItsLimit) {
  ControllerSpec spec;
  spec.acceleration_limit_mps2 = 3;
  const auto vehicle = nominal_vehicle();
  VelocityController controller(spec, vehicle);
  StateReading state;
  controller.update(state, normal(Vector3d::Zero()));
  state.t_us = 4000;
  const Vector3d a_W =
      desired_a_B(controller.update(state, normal({6, 8, 0})), state.v_W, spec, vehicle);
  const Vector3d a_ref = 3 * Vector3d(0.6, 0.8, 0), v_ref = 0.004 * a_ref;
  const double gain_1ps = spec.velocity_gain_xy_1ps + 0.004 * spec.position_gain_xy_1ps2;
  const Vector3d expected =
      kHover + a_ref + gain_1ps * v_ref + vehicle.drag_1ps.cwiseProduct(v_ref);
  EXPECT_TRUE(a_W.isApprox(expected, 1e-9)) << a_W.transpose();
}

TEST(VelocityControllerLimits, TheVelocityErrorCountsUpToItsClipOnEachAxis) {
  const ControllerSpec spec;
  VelocityController controller(spec, nominal_vehicle());
  StateReading state;
  controller.update(state, normal(Vector3d::Zero()));
  state.v_W = {3, -3, -2};
  const Vector3d a_W = desired_a_B(controller.update(state, normal(Vector3d::Zero())), state.v_W,
                                   spec, nominal_vehicle());
  const double xy_mps2 = spec.velocity_gain_xy_1ps * spec.velocity_clip_xy_mps;
  const double z_mps2 = spec.velocity_gain_z_1ps * spec.velocity_clip_z_mps;
  EXPECT_TRUE(a_W.isApprox(kHover + Vector3d(-xy_mps2, xy_mps2, z_mps2), 1e-9)) << a_W.transpose();
}

TEST(VelocityControllerLimits, TheVelocityErrorCountsUpToAnotherClipWhileEvading) {
  ControllerSpec spec;
  spec.evading_velocity_clip_mps = 2;
  VelocityController controller(spec, nominal_vehicle());
  StateReading state;
  state.v_W = {5, -1, -3};
  const Vector3d a_W = desired_a_B(controller.update(state, evade(Vector3d::Zero())), state.v_W,
                                   spec, nominal_vehicle());
  const Vector3d expected = kHover + spec.evading_velocity_gain_1ps * Vector3d(-2, 1, 2);
  EXPECT_TRUE(a_W.isApprox(expected, 1e-9)) << a_W.transpose();
}

TEST(VelocityControllerLimits, TheThrustIsNeverNegativeHoweverTheVehicleIsTurned) {
  const ControllerSpec spec;
  VelocityController controller(spec, nominal_vehicle());
  StateReading state;
  state.q_W = Eigen::AngleAxisd(3, Vector3d::UnitX());  // nearly on its back
  EXPECT_EQ(controller.update(state, evade(Vector3d::Zero())).thrust_mps2, spec.min_thrust_mps2);
  // Never negative, where the rotors gain more than that from the flight.
  state.v_W = {20, 0, 0};
  EXPECT_EQ(controller.update(state, evade(Vector3d::Zero())).thrust_mps2, 0);
}

}  // namespace
}  // namespace dodgesim
