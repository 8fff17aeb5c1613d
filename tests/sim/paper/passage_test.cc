#include "sim/paper/passage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/base/random.h"
#include "tests/sim/paper/synthetic_passage.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

// All points of a sphere against the border pixels, one by one.
bool every_point_in_image(const Intrinsics& intrinsics, const Vector3d& p_C, double radius_m) {
  constexpr int kPoints = 20000;
  for (int i = 0; i < kPoints; ++i) {  // spiral of equal areas
    const double z = 1 - (2 * i + 1.0) / kPoints, r = std::sqrt(1 - z * z);
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const Vector3d point = p_C + radius_m * Vector3d(r * std::cos(angle), r * std::sin(angle), z);
    const Eigen::Vector2d pixel = intrinsics.project(point);
    if (point.z() <= 0 || pixel.x() < -0.5 || pixel.x() > intrinsics.width - 0.5 ||
        pixel.y() < -0.5 || pixel.y() > intrinsics.height - 0.5) {
      return false;
    }
  }
  return true;
}

TEST(WholeInImage, IsWhatEveryPointOfTheSphereSays) {
  const Intrinsics intrinsics;
  RandomStream random(1, 0, "spheres");
  int inside = 0;
  for (int i = 0; i < 200; ++i) {
    const double z = random.uniform(0.2, 1.5);
    const Vector3d p_C(random.uniform(-z, z), random.uniform(-0.8 * z, 0.8 * z), z);
    const double radius_m = random.uniform(0.02, 0.15);
    const bool whole = whole_in_image(intrinsics, p_C, radius_m);
    // The points are dense to about 1 % of the radius.
    if (whole != whole_in_image(intrinsics, p_C, 0.98 * radius_m)) continue;
    EXPECT_EQ(whole, every_point_in_image(intrinsics, p_C, radius_m)) << p_C.transpose();
    inside += whole ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
  EXPECT_LT(inside, 150);
}

TEST(WholeInImage, IsFalseBehindTheCamera) {
  EXPECT_FALSE(whole_in_image({}, {0, 0, -1}, 0.1));
  EXPECT_FALSE(centre_in_image({}, {0, 0, -1}));
}

TEST(ObjectView, NeedsTheCentreInEveryCamerasImage) {
  const CameraRig rig = stereo_rig();
  const Eigen::Isometry3d at_rest = Eigen::Isometry3d::Identity();
  const double limit_m = 0.5 * 120 / rig.intrinsics.f - 0.075;  // of the lower camera at 0.5 m
  EXPECT_TRUE(view_of(rig, at_rest, {0.5, 0, limit_m - 1e-6}, 0.05).centre_in_view);
  const ObjectView outside = view_of(rig, at_rest, {0.5, 0, limit_m + 1e-6}, 0.05);
  EXPECT_FALSE(outside.centre_in_view);
  EXPECT_TRUE(centre_in_image(rig.intrinsics, outside.p_C));  // the upper camera's
  EXPECT_NEAR(outside.depth_m(), 0.5, 1e-12);
  EXPECT_NEAR(outside.range_m(), std::hypot(0.5, limit_m + 1e-6 - 0.075), 1e-12);
}

TEST(OnOutline, AsksForTheDirectionAndNotForTheDistance) {
  const ObjectView view = view_of(stereo_rig(), Eigen::Isometry3d::Identity(), {1, 0, 0.075}, 0.1);
  EXPECT_TRUE(on_outline(view, {1, 0, 0.075}));
  EXPECT_TRUE(on_outline(view, {3, 0, 0.075}));
  EXPECT_FALSE(on_outline(view, {-1, 0, 0.075}));
  const double edge_rad = std::asin(0.1) + kOutlineMarginRad;
  for (const double distance_m : {0.4, 1.0, 2.5}) {
    const auto aside = [&](double angle_rad) {
      return Vector3d(distance_m * std::cos(angle_rad), distance_m * std::sin(angle_rad), 0.075);
    };
    EXPECT_TRUE(on_outline(view, aside(edge_rad - 1e-6)));
    EXPECT_FALSE(on_outline(view, aside(edge_rad + 1e-6)));
  }
}

TEST(Passage, FollowsAFallingBallToHalfAMillimetre) {
  Trajectory trajectory = straight_flight({3, 0, 0}, {-5, 0, 0}, 0.2);
  const auto position = [](TimeUs t_us) {
    const double t = seconds(t_us - 500000);
    return Vector3d(3 - 5 * t, 0, 2 * t - 4.905 * t * t);
  };
  for (std::size_t i = 0; i < trajectory.samples.size(); ++i) {
    trajectory.samples[i].objects = {position(500000 + 20000 * static_cast<TimeUs>(i))};
  }
  const Passage passage(trajectory, stereo_rig());
  for (TimeUs t_us = 500000; t_us <= 1500000; t_us += 1700) {
    const std::optional<ObjectView> view = passage.at(t_us);
    ASSERT_TRUE(view);
    EXPECT_LT((view->X_WC * view->p_C - position(t_us)).norm(), 0.0006) << t_us;
    EXPECT_EQ(view->radius_m, 0.1);
  }
  EXPECT_FALSE(passage.at(499999));
  EXPECT_FALSE(passage.at(1500001));
}

TEST(Passage, TurnsWithTheVehicle) {
  Trajectory trajectory = straight_flight({1, 0, 0.075}, {0, 0, 0}, 0.2);
  for (std::size_t i = 0; i < trajectory.samples.size(); ++i) {
    trajectory.samples[i].q_W = Eigen::AngleAxisd(0.02 * static_cast<double>(i), Vector3d::UnitZ());
  }
  const Passage passage(trajectory, stereo_rig());
  for (const TimeUs t_us : {500000, 707000, 1311000}) {
    const double yaw_rad = seconds(t_us - 500000);
    EXPECT_NEAR(passage.at(t_us)->depth_m(), std::cos(yaw_rad), 1e-9);  // the ball moves right
    EXPECT_NEAR(passage.at(t_us)->p_C.x(), std::sin(yaw_rad), 1e-9);
  }
}

TEST(Passage, BeginsWithTheLaunch) {
  Trajectory trajectory = straight_flight({3, 0, 0}, {-5, 0, 0}, 0.2);
  for (std::size_t i = 0; i < 10; ++i) trajectory.samples[i].objects = {std::nullopt};
  const Passage passage(trajectory, stereo_rig());
  EXPECT_FALSE(passage.at(690000));
  EXPECT_TRUE(passage.at(700000));
}

}  // namespace
}  // namespace dodgesim
