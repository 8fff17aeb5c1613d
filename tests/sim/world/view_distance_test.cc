#include "sim/world/view_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/base/random.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

const Intrinsics kCamera{320, 240, 190.68};

WorldSpec room_spec() {
  WorldSpec spec = test_spec();
  spec.room = "room";
  return spec;
}

// A camera at the vehicle's centre, turned about its axes.
Eigen::Isometry3d camera(double up_rad = 0) {
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  X_BC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  X_BC.linear() = Eigen::AngleAxisd(-up_rad, Vector3d::UnitY()) * X_BC.linear();
  return X_BC;
}

double distance(const World& world, const Eigen::Isometry3d& X_BC) {
  return ViewDistance(kCamera).nearest_m(world, world.snapshot(), X_BC);
}

// Of the floor h below a level camera: where the middle of the image's lower border meets it.
double to_floor(double height_m) { return height_m * std::hypot(1, kCamera.f / 120); }

TEST(ViewDistance, IsTheDistanceToTheFloorAtTheImagesLowerBorder) {
  World world(test_spec());  // an open field
  for (const double height_m : {0.5, 1.0, 3.0}) {
    world.reset({0, 0, height_m}, 0.4, Vector3d::Zero());
    EXPECT_NEAR(distance(world, camera()), to_floor(height_m), 1e-9);
  }
}

TEST(ViewDistance, IsTheDistanceToAWallAhead) {
  World world(room_spec());
  const double half_turn = M_PI;  // the wall behind: nothing stands before its middle
  world.reset({-4.5, -0.5, 2.5}, half_turn, Vector3d::Zero());
  EXPECT_NEAR(distance(world, camera()), 1.5, 1e-9);
}

TEST(ViewDistance, IsInfiniteInTheSky) {
  World world(test_spec());
  world.reset({0, 0, 3}, 0, Vector3d::Zero());
  EXPECT_EQ(distance(world, camera(M_PI / 2)), std::numeric_limits<double>::infinity());
}

TEST(ViewDistance, ThrownObjectsAndTheVehicleItselfDoNotCount) {
  World world(room_spec());
  world.reset({0, 0, 2}, 0, Vector3d::Zero());
  const double empty = distance(world, camera());
  BodyState ball;
  ball.p_W = {0.5, 0, 2};
  world.launch(0, ball);
  EXPECT_EQ(distance(world, camera()), empty);
}

TEST(ViewDistance, TakesOffWhatTheVehicleHasMovedUntilTheRaysAreCastAgain) {
  World world(test_spec());
  const double speed_mps = 4;
  world.reset({0, 0, 2}, 0, {speed_mps, 0, 0});  // along the floor: the distance stays
  ViewDistance view(kCamera);
  const Eigen::Isometry3d X_BC = camera();
  double before_m = view.nearest_m(world, world.snapshot(), X_BC);
  EXPECT_NEAR(before_m, to_floor(2), 1e-9);
  for (int tick = 1; tick <= 100; ++tick) {
    world.step(hover(world));
    const Snapshot& now = world.snapshot();
    const double nearest_m = view.nearest_m(world, now, X_BC);
    const double since_cast_s = 0.01 * std::fmod(seconds(now.t_us) / 0.01 + 1e-9, 1.0);
    // The vehicle coasts, with a little drag, at a constant height.
    EXPECT_NEAR(nearest_m, to_floor(2) - speed_mps * since_cast_s, 5e-4) << now.t_us;
    EXPECT_LE(nearest_m, to_floor(2) + 1e-4);
  }
}

TEST(ViewDistance, CastsAgainWhenTimeStartsAgain) {
  World world(test_spec());
  ViewDistance view(kCamera);
  world.reset({0, 0, 3}, 0, Vector3d::Zero());
  for (int tick = 0; tick < 4; ++tick) world.step(hover(world));
  view.nearest_m(world, world.snapshot(), camera());
  world.reset({0, 0, 1}, 0, Vector3d::Zero());
  EXPECT_NEAR(view.nearest_m(world, world.snapshot(), camera()), to_floor(1), 1e-9);
}

// The nearest hit of rays twelve times as dense.
double dense_nearest(const World& world, const Eigen::Isometry3d& X_WC) {
  constexpr mjtByte kRoomOnly[mjNGROUP] = {1, 0, 0, 0, 0, 0};
  double nearest_m = std::numeric_limits<double>::infinity();
  const Vector3d p_W = X_WC.translation();
  for (int j = -72; j <= 72; ++j) {
    for (int i = -96; i <= 96; ++i) {
      const Vector3d ray_C(160.0 * i / 96, 120.0 * j / 72, kCamera.f);
      const Vector3d ray_W = X_WC.linear() * ray_C.normalized();
      int geom = -1;
      const double at_m =
          mj_ray(&world.model(), &world.data(), p_W.data(), ray_W.data(), kRoomOnly, 1, -1, &geom);
      if (geom >= 0) nearest_m = std::min(nearest_m, at_m);
    }
  }
  return nearest_m;
}

TEST(ViewDistance, MissesLittleOfTheFurniture) {
  World world(room_spec());
  RandomStream random(1, 0, "view_distance_test");
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    // Near the furniture, looking away from the floor, which is easy.
    const Vector3d p_W(random.uniform(-4.5, 4.5), random.uniform(-2.5, 2.5), random.uniform(1, 2));
    const Eigen::Isometry3d X_BC = camera(random.uniform(0.1, 0.5));
    world.reset(p_W, random.uniform(-M_PI, M_PI), Vector3d::Zero());
    const double dense_m = dense_nearest(world, world.snapshot().vehicle.pose() * X_BC);
    const double nearest_m = distance(world, X_BC);
    EXPECT_GE(nearest_m, dense_m - 1e-9);  // its rays are among the dense ones
    worst = std::max(worst, nearest_m / dense_m);
  }
  EXPECT_LT(worst, 1.04);
}

}  // namespace
}  // namespace dodgesim
