#include "sim/world/throw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "tests/models.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const ObjectPhysics kBall20cm = {0.38, 0.47 * M_PI / 4 * 0.04, 0.1};
const ObjectPhysics kNoDrag = {0.38, 0, 0.1};

Throw random_throw(RandomStream& random) {
  Throw toss;
  toss.speed_mps = random.uniform(2, 12);
  toss.distance_m = random.uniform(1, 6);
  toss.bearing_deg = random.uniform(-40, 40);
  toss.aim_offset_m = Vector2d(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
  toss.launch_height_m = random.uniform(1, 3);
  toss.spin_radps = Vector3d(random.uniform(-20, 20), 0, 0);
  return toss;
}

// An integrator of another kind (leapfrog, drag implicit), ten times finer.
Vector3d fly_independently(const ObjectPhysics& object, double time_s, BodyState state) {
  const int steps = static_cast<int>(std::ceil(time_s / 1e-4));
  const double dt = time_s / steps;
  const double k = 0.5 * 1.2 * object.drag_area_m2 / object.mass_kg;
  for (int i = 0; i < steps; ++i) {
    state.p_W += 0.5 * dt * state.v_W;
    state.v_W += dt * Vector3d(0, 0, -9.81);
    state.v_W /= 1 + dt * k * state.v_W.norm();
    state.p_W += 0.5 * dt * state.v_W;
  }
  return state.p_W;
}

TEST(ThrowTest, WithoutDragTheLaunchVelocityIsThatOfTheParabola) {
  Throw toss;
  toss.speed_mps = 6;
  toss.distance_m = 3;
  toss.launch_height_m = 1.5;
  const BodyState launch = solve_throw(toss, kNoDrag, Vector3d(0, 0, 2), 0);
  EXPECT_TRUE(launch.p_W.isApprox(Vector3d(3, 0, 1.5), 1e-12));
  EXPECT_TRUE(launch.v_W.isApprox(Vector3d(-6, 0, 0.5 / 0.5 + 0.5 * 9.81 * 0.5), 1e-12));
}

TEST(ThrowTest, TheFlightReachesTheAimPointInTime) {
  RandomStream random(1, 0, "throw");
  for (int i = 0; i < 60; ++i) {
    const Throw toss = random_throw(random);
    const Vector3d vehicle_W(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(1, 3));
    const double heading_rad = random.uniform(-3, 3);
    const BodyState launch = solve_throw(toss, kBall20cm, vehicle_W, heading_rad);
    const Vector3d aim_W = aim_point(toss, vehicle_W, heading_rad);
    EXPECT_LT((fly_independently(kBall20cm, toss.flight_s(), launch) - aim_W).norm(), 1e-3);
    Vector3d p_W = launch.p_W, v_W = launch.v_W;
    fly(kBall20cm, toss.flight_s(), p_W, v_W);
    EXPECT_LT((p_W - aim_W).norm(), 1e-4);
    EXPECT_NEAR((launch.p_W - aim_W).head<2>().norm(), toss.distance_m, 1e-9);
    EXPECT_NEAR(launch.p_W.z(), toss.launch_height_m, 1e-12);
    EXPECT_EQ(launch.w_W, toss.spin_radps);
  }
}

TEST(ThrowTest, TheFlightAgreesWithAFinerIndependentIntegration) {
  RandomStream random(2, 0, "throw");
  for (int i = 0; i < 20; ++i) {
    BodyState state;
    state.v_W = Vector3d(random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(-2, 8));
    Vector3d p_W = state.p_W, v_W = state.v_W;
    fly(kBall20cm, 1.0, p_W, v_W);
    // The independent integrator is of first order in the drag: its own error is below 0.1 mm.
    EXPECT_LT((p_W - fly_independently(kBall20cm, 1.0, state)).norm(), 1e-4);
  }
}

TEST(ThrowTest, NoHandThrowsFasterThan100MetresASecond) {
  const auto complaint = [](const ObjectPhysics& object, double speed_mps,
                            double vehicle_height_m) -> std::string {
    Throw toss;
    toss.distance_m = 3;
    toss.speed_mps = speed_mps;
    try {
      solve_throw(toss, object, Vector3d(0, 0, vehicle_height_m), 0);
    } catch (const ScenarioError& error) {
      return error.what();
    }
    return "accepted";
  };
  const ObjectPhysics light{.mass_kg = 0.1, .drag_area_m2 = 0.2};  // falls slowly
  EXPECT_THAT(complaint(light, 0.5, 2), ::testing::HasSubstr("raise throw.speed_mps"));
  EXPECT_THAT(complaint(kBall20cm, 6, 80),
              ::testing::HasSubstr("bring throw.launch_height_m nearer"));
}

TEST(ThrowTest, BearingAndOffsetAreMeantFromTheVehicle) {
  Throw toss;
  toss.bearing_deg = 30;
  toss.aim_offset_m = Vector2d(0.2, 0.1);
  const Vector3d vehicle_W(1, 1, 2);
  // Heading 60 degrees left and 30 more: the throw comes along -y, left is -x.
  const double heading_rad = M_PI / 3;
  EXPECT_TRUE(aim_point(toss, vehicle_W, heading_rad).isApprox(Vector3d(0.8, 1, 2.1), 1e-12));
  const BodyState launch = solve_throw(toss, kBall20cm, vehicle_W, heading_rad);
  EXPECT_TRUE(launch.p_W.isApprox(Vector3d(0.8, 4, 1.5), 1e-12));
  toss.bearing_deg = 30 - 360;
  EXPECT_TRUE(solve_throw(toss, kBall20cm, vehicle_W, heading_rad).p_W.isApprox(launch.p_W, 1e-12));
}

TEST(ThrowTest, LeftAndRightThrowsAreMirrorImages) {
  RandomStream random(3, 0, "throw");
  for (int i = 0; i < 20; ++i) {
    const Throw left = random_throw(random);
    Throw right = left;
    right.bearing_deg = -left.bearing_deg;
    right.aim_offset_m.x() = -left.aim_offset_m.x();
    const BodyState a = solve_throw(left, kBall20cm, Vector3d(0, 0, 2), 0);
    const BodyState b = solve_throw(right, kBall20cm, Vector3d(0, 0, 2), 0);
    const Vector3d mirror(1, -1, 1);
    EXPECT_LT((a.p_W.cwiseProduct(mirror) - b.p_W).norm(), 1e-9);
    EXPECT_LT((a.v_W.cwiseProduct(mirror) - b.v_W).norm(), 1e-9);
  }
}

TEST(ThrowTest, ImpossibleThrowsAreRefused) {
  const Vector3d vehicle_W(0, 0, 2);
  Throw toss;
  toss.speed_mps = 0;
  EXPECT_THROW(solve_throw(toss, kBall20cm, vehicle_W, 0), ScenarioError);
  toss.speed_mps = std::nan("");
  EXPECT_THROW(solve_throw(toss, kBall20cm, vehicle_W, 0), ScenarioError);
  toss.speed_mps = 6;
  toss.distance_m = -1;
  EXPECT_THROW(solve_throw(toss, kBall20cm, vehicle_W, 0), ScenarioError);
}

TEST(ThrowTest, EveryThrowAScenarioAllowsHasASolution) {
  for (const double speed_mps : {0.5, 1.0, 5.0, 15.0, 30.0}) {
    for (const double distance_m : {0.5, 2.0, 6.0, 20.0}) {
      Throw toss;
      toss.speed_mps = speed_mps;
      toss.distance_m = distance_m;
      if (toss.flight_s() > 10) continue;  // higher than any room, faster than any hand
      EXPECT_NO_THROW(solve_throw(toss, kBall20cm, Vector3d(0, 0, 2), 0))
          << speed_mps << " m/s over " << distance_m << " m";
    }
  }
}

TEST(ThrowTest, InTheWorldTheObjectPassesTheAimPoint) {
  RandomStream random(4, 0, "throw");
  World world(test_spec({{"ball", 0.2}, {"box", 0.3}}));
  for (int i = 0; i < 8; ++i) {
    Throw toss = random_throw(random);
    toss.launch_height_m = 11;
    const Vector3d aim_W(0, 0, 12);  // far above the vehicle and whatever stands on the field
    world.reset(Vector3d(0, 0, 5), 0, Vector3d::Zero());
    const int object = i % 2;
    world.launch(object, solve_throw(toss, world.object(object), aim_W, 0));
    while (world.snapshot().t_us + kTickUs <= toss.arrival_us()) world.step(hover(world));
    const Snapshot before = world.snapshot();
    world.step(hover(world));
    const Snapshot at = interpolate(before, world.snapshot(), toss.arrival_us());
    EXPECT_LT((at.objects[static_cast<std::size_t>(object)].p_W - aim_point(toss, aim_W, 0)).norm(),
              2e-4);
  }
}

TEST(ThrowTest, InTheWorldTheFlightAgreesWithItsIntegrationOverASecond) {
  BodyState launch;
  launch.p_W = Vector3d(5, 0, 9);
  launch.v_W = Vector3d(8, -3, 5);
  World world(test_spec());
  world.reset(Vector3d(0, 0, 5), 0, Vector3d::Zero());
  world.launch(0, launch);
  for (int i = 0; i < 4000; ++i) world.step(hover(world));
  const Vector3d flown_W = world.snapshot().objects[0].p_W;
  Vector3d p_W = launch.p_W, v_W = launch.v_W;
  fly(world.object(0), 1.0, p_W, v_W);
  EXPECT_LT((flown_W - p_W).norm(), 1e-5);
  EXPECT_LT((flown_W - fly_independently(world.object(0), 1.0, launch)).norm(), 1e-3);
}

TEST(ThrowTest, InTheWorldAFlightWithoutDragIsTheParabola) {
  const testing::TemporaryDirectory directory;
  const std::filesystem::path models = testing::copy_models(directory.path());
  const std::filesystem::path ball = models / "objects/ball.xml";
  std::string model = testing::contents(ball);
  const std::string drag = "\"drag_coefficient\" data=\"0.47\"";
  model.replace(model.find(drag), drag.size(), "\"drag_coefficient\" data=\"0\"");
  testing::put(ball, model);
  WorldSpec spec = test_spec({{"ball", 0.2}});
  spec.models_dir = models.string();
  World world(spec);
  ASSERT_EQ(world.object(0).drag_area_m2, 0);
  BodyState launch;
  launch.p_W = Vector3d(5, 0, 9);
  launch.v_W = Vector3d(8, -3, 5);
  launch.w_W = Vector3d(10, 20, 30);
  world.reset(Vector3d(0, 0, 5), 0, Vector3d::Zero());
  world.launch(0, launch);
  for (int i = 1; i <= 4000; ++i) {
    world.step(hover(world));
    const double t = i * 250e-6;
    const Vector3d parabola = launch.p_W + t * launch.v_W - Vector3d(0, 0, 0.5 * 9.81 * t * t);
    ASSERT_LT((world.snapshot().objects[0].p_W - parabola).norm(), 1e-9) << "after " << t << " s";
  }
}

}  // namespace
}  // namespace dodgesim
