// What a scenario changes about its vehicle holds for physics, parameters and cameras alike.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

WorldSpec with(const VehicleOverrides& overrides) {
  WorldSpec spec = test_spec({});
  spec.vehicle_overrides = overrides;
  return spec;
}

// Velocity after 100 ms with these thrusts, from rest high above the ground.
BodyState after_100_ms(World& world, const std::array<double, 4>& thrust_n) {
  world.reset({0, 0, 50}, 0, {0, 0, 0});
  for (TimeUs t = 0; t < 100000; t += kTickUs) world.step(thrust_n);
  return world.snapshot().vehicle;
}

TEST(VehicleOverrides, AHeavierVehicleRisesMoreSlowly) {
  VehicleOverrides overrides;
  overrides.mass_scale = 1.5;
  World heavy(with(overrides)), usual(with({}));
  EXPECT_DOUBLE_EQ(heavy.vehicle().mass_kg, 1.5 * usual.vehicle().mass_kg);
  const double thrust_n = 6;
  const double v = after_100_ms(heavy, {thrust_n, thrust_n, thrust_n, thrust_n}).v_W.z();
  EXPECT_NEAR(v, 0.1 * (4 * thrust_n / heavy.vehicle().mass_kg - kGravityMps2), 1e-3);
  const double hover_v = after_100_ms(heavy, hover(heavy)).v_W.z();
  EXPECT_NEAR(hover_v, 0, 1e-9);
}

TEST(VehicleOverrides, DragStaysTheForceThatItIs) {
  VehicleOverrides overrides;
  overrides.mass_scale = 2;
  World heavy(with(overrides)), usual(with({}));
  EXPECT_TRUE((2 * heavy.vehicle().drag_1ps).isApprox(usual.vehicle().drag_1ps));
  EXPECT_DOUBLE_EQ(2 * heavy.vehicle().drag_kh_1pm, usual.vehicle().drag_kh_1pm);
  const auto slowing = [](World& world) {
    world.reset({0, 0, 50}, 0, {4, 0, 0});
    world.step(hover(world));
    return world.vehicle().mass_kg * (4 - world.snapshot().vehicle.v_W.x());
  };
  EXPECT_NEAR(slowing(heavy), slowing(usual), 1e-4 * slowing(usual));
}

TEST(VehicleOverrides, InertiaSlowsTheRotation) {
  VehicleOverrides overrides;
  overrides.mass_scale = 2;  // as its rotors' turning would lift a lighter one
  overrides.inertia_scale = 2;
  World slow(with(overrides)), usual(with({}));
  EXPECT_TRUE(slow.vehicle().inertia_kgm2.isApprox(2 * usual.vehicle().inertia_kgm2));
  const std::array<double, 4> roll = {3, 2.9, 2.9, 3};
  const double w_slow = after_100_ms(slow, roll).w_W.norm();
  const double w_usual = after_100_ms(usual, roll).w_W.norm();
  EXPECT_GT(w_usual, 0.01);
  EXPECT_NEAR(w_slow, 0.5 * w_usual, 0.02 * w_usual);
}

TEST(VehicleOverrides, ThrustIsClippedAtTheNewLimit) {
  VehicleOverrides overrides;
  overrides.max_thrust_n = 4;
  World weak(with(overrides));
  EXPECT_EQ(weak.vehicle().max_thrust_n, 4);
  const double v = after_100_ms(weak, {9, 9, 9, 9}).v_W.z();
  EXPECT_NEAR(v, 0.1 * (16 / weak.vehicle().mass_kg - kGravityMps2), 1e-3);
  overrides.max_thrust_n = 2.5;
  try {
    World too_weak(with(overrides));
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("the rotors lift only 1.0"));
  }
}

TEST(VehicleOverrides, TheBaselineMovesBothCamerasAboutTheirMiddle) {
  VehicleOverrides overrides;
  overrides.stereo_baseline_m = 0.4;
  const World wide(with(overrides)), usual(with({}));
  const auto p = [](const World& world, std::size_t camera) -> Eigen::Vector3d {
    return world.vehicle().X_BC.at(camera).translation();
  };
  EXPECT_NEAR((p(wide, 0) - p(wide, 1)).norm(), 0.4, 1e-12);
  EXPECT_TRUE((p(wide, 0) + p(wide, 1)).isApprox(p(usual, 0) + p(usual, 1)));
  EXPECT_GT(p(wide, 0).z(), p(usual, 0).z());
  EXPECT_TRUE(wide.vehicle().X_BC[0].linear().isApprox(usual.vehicle().X_BC[0].linear()));
}

TEST(VehicleOverrides, TheLowerCameraTurnsAboutItsOwnAxes) {
  VehicleOverrides overrides;
  overrides.lower_camera_turn_deg = {0.3, -0.2, 0.1};
  const World turned(with(overrides)), usual(with({}));
  EXPECT_TRUE(turned.vehicle().X_BC[0].isApprox(usual.vehicle().X_BC[0], 0));
  const Eigen::Isometry3d X_CT = usual.vehicle().X_BC[1].inverse() * turned.vehicle().X_BC[1];
  EXPECT_LT(X_CT.translation().norm(), 1e-12);
  const Eigen::AngleAxisd turn(X_CT.linear());
  EXPECT_NEAR(turn.angle(), std::sqrt(0.14) * M_PI / 180, 1e-9);
  EXPECT_TRUE(turn.axis().isApprox(Eigen::Vector3d(0.3, -0.2, 0.1).normalized(), 1e-6));
}

}  // namespace
}  // namespace dodgesim
