#include "dodge/detect/ego_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "sim/base/random.h"

namespace dodge {
namespace {

constexpr TimeUs kBeginUs = 1000000;
constexpr TimeUs kEndUs = 1010000;

Eigen::Matrix3d rotation(const Eigen::Vector3d& v) {
  return v.norm() > 0 ? Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix()
                      : Eigen::Matrix3d::Identity();
}

Eigen::Vector3d ray(const CameraModel& camera, double u, double v) {
  return camera.bearing({u, v}).homogeneous();
}

TEST(Rodrigues, AgreesWithTheAngleAxisForm) {
  for (const Eigen::Vector3d& v :
       {Eigen::Vector3d(0.3, -0.2, 0.9), Eigen::Vector3d(1e-5, 0, 0), Eigen::Vector3d(0, 0, 3)}) {
    EXPECT_LT((rodrigues(v) - rotation(v)).norm(), 1e-12);
  }
  EXPECT_EQ(rodrigues(Eigen::Vector3d::Zero()), Eigen::Matrix3d::Identity());
}

TEST(EgoMotion, LeavesPixelsInPlaceWithoutRotation) {
  const CameraModel camera;
  EgoMotion ego_motion({}, camera);
  ego_motion.set_motion(Eigen::Vector3d::Zero(), kBeginUs, kEndUs);
  for (int y = 0; y < camera.height; y += 7) {
    for (int x = 0; x < camera.width; x += 7) {
      const Eigen::Vector2f warped = ego_motion.warp({.t_us = kBeginUs + 50 * x,
                                                      .x = static_cast<std::uint16_t>(x),
                                                      .y = static_cast<std::uint16_t>(y)});
      EXPECT_NEAR(warped.x(), x, 1e-3);
      EXPECT_NEAR(warped.y(), y, 1e-3);
    }
  }
}

// The largest error over random events of static rays: each is seen where the rotated camera sees
// it at its time, and must land where the camera sees it at the reference instant.
double largest_error(const CameraModel& camera, const EgoMotionConfig& config,
                     const Eigen::Vector3d& w, TimeUs reference_us) {
  EgoMotion ego_motion(config, camera);
  ego_motion.set_motion(w, kBeginUs, kEndUs);
  dodgesim::RandomStream random(1, 0, "events");
  double largest = 0;
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Event event{.t_us = kBeginUs + 1 + static_cast<TimeUs>(random.uniform(0, 9999)),
                      .x = static_cast<std::uint16_t>(random.uniform(0, camera.width)),
                      .y = static_cast<std::uint16_t>(random.uniform(0, camera.height))};
    const double dt_s = 1e-6 * static_cast<double>(event.t_us - reference_us);
    const Eigen::Vector3d d = rotation(w * dt_s) * ray(camera, event.x, event.y);
    const Eigen::Vector2d expected = camera.project(d);
    if (expected.x() < 0 || expected.x() >= camera.width) continue;
    if (expected.y() < 0 || expected.y() >= camera.height) continue;
    ++compared;
    const Eigen::Vector2d warped = ego_motion.warp(event).cast<double>();
    EXPECT_TRUE(warped.allFinite());
    largest = std::max(largest, (warped - expected).norm());
  }
  EXPECT_GT(compared, 10000);
  return largest;
}

TEST(EgoMotion, IsExactToItsBoundAtTheEndAndAtTheStart) {
  const CameraModel camera;
  for (const double rate : {0.1, 1.0, 8.0, 15.0}) {
    const Eigen::Vector3d w = rate * Eigen::Vector3d(0.6, -0.7, 0.4).normalized();
    EXPECT_LT(largest_error(camera, {}, w, kEndUs), 0.021) << rate;
    EXPECT_LT(largest_error(camera, {.reference = "start"}, w, kBeginUs), 0.021) << rate;
  }
}

TEST(EgoMotion, WarpsManyEventsAsEachAlone) {
  const CameraModel camera;
  EgoMotion ego_motion({}, camera);
  ego_motion.set_motion({3, -5, 2}, kBeginUs, kEndUs);
  dodgesim::RandomStream random(1, 1, "events");
  std::vector<Event> events;
  events.reserve(1000);
  for (int i = 0; i < 1000; ++i) {  // some before the window, some after it
    events.push_back({.t_us = kBeginUs - 100 + 11 * i,
                      .x = static_cast<std::uint16_t>(random.uniform(0, camera.width)),
                      .y = static_cast<std::uint16_t>(random.uniform(0, camera.height))});
  }
  std::vector<float> u(events.size()), v(events.size());
  ego_motion.warp(events, u.data(), v.data());
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Eigen::Vector2f alone = ego_motion.warp(events[i]);
    ASSERT_EQ(u[i], alone.x()) << i;
    ASSERT_EQ(v[i], alone.y()) << i;
  }
}

TEST(EgoMotion, WhatHasTurnedBehindTheCameraIsOutsideOfTheImage) {
  const CameraModel camera;
  EgoMotion ego_motion({}, camera);
  ego_motion.set_motion({0, 25, 0}, 0, 100000);  // by 2.5 rad
  for (int x = 0; x < camera.width; x += 16) {
    const Eigen::Vector2f at =
        ego_motion.warp({.t_us = 0, .x = static_cast<std::uint16_t>(x), .y = 120});
    EXPECT_TRUE(at.x() < -100 || at.x() > static_cast<float>(camera.width) + 100) << x;
  }
}

// A broken gyroscope: what it says is finite, its square is not. Nothing is in the image then.
TEST(EgoMotion, OfAbsurdRatesSeesNothing) {
  const CameraModel camera;
  EgoMotion ego_motion({}, camera);
  const double huge = 1.7e308, infinite = std::numeric_limits<double>::infinity();
  const std::vector<Event> events = {{.t_us = kBeginUs, .x = 9, .y = 9},
                                     {.t_us = kEndUs, .x = 300, .y = 200}};
  for (const Eigen::Vector3d& w : {Eigen::Vector3d(huge, 0, 0), Eigen::Vector3d(huge, -huge, huge),
                                   Eigen::Vector3d(infinite, 0, std::nan(""))}) {
    ego_motion.set_motion(w, kBeginUs, kBeginUs);  // no time to turn in
    ego_motion.set_motion(w, kBeginUs, kEndUs);
    std::vector<float> u(events.size()), v(events.size());
    ego_motion.warp(events, u.data(), v.data());
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_FALSE(u[i] >= 0 && u[i] < 320 && v[i] >= 0 && v[i] < 240) << w.transpose();
    }
  }
  ego_motion.set_motion(Eigen::Vector3d::Zero(), kBeginUs, kEndUs);
  EXPECT_NEAR(ego_motion.warp(events[0]).x(), 9, 1e-3);
}

TEST(EgoMotion, Undistorts) {
  CameraModel camera{.width = 240,
                     .height = 180,
                     .fx = 199.1,
                     .fy = 198.8,
                     .cx = 132.2,
                     .cy = 110.7,
                     .k1 = -0.368,
                     .k2 = 0.151,
                     .p1 = -0.0003,
                     .p2 = -0.00076};
  EXPECT_LT(largest_error(camera, {}, {1.97, -0.11, 1.15}, kEndUs), 0.021);
}

// A line of sight is what distorts to its pixel, by the equations of OpenCV's manual, where that is
// stretched so much that fixed-point steps do not converge.
TEST(EgoMotion, LinesOfSightDistortToTheirPixels) {
  const CameraModel camera{.k1 = 0.4, .k2 = 0.05, .p1 = 0.002, .p2 = -0.003, .k3 = 0.01};
  for (int y = 0; y < camera.height; y += 7) {
    for (int x = 0; x < camera.width; x += 7) {
      const Eigen::Vector2d p = camera.bearing({x, y});
      const double r2 = p.squaredNorm(),
                   radial = 1 + camera.k1 * r2 + camera.k2 * r2 * r2 + camera.k3 * r2 * r2 * r2;
      const double u =
          p.x() * radial + 2 * camera.p1 * p.x() * p.y() + camera.p2 * (r2 + 2 * p.x() * p.x());
      const double v =
          p.y() * radial + camera.p1 * (r2 + 2 * p.y() * p.y()) + 2 * camera.p2 * p.x() * p.y();
      ASSERT_NEAR(camera.fx * u + camera.cx, x, 1e-6);
      ASSERT_NEAR(camera.fy * v + camera.cy, y, 1e-6);
    }
  }
}

TEST(EgoMotion, AStaticEdgeSeenFromAYawingCameraStaysWhereItIsNow) {
  // Camera axes: x right, y down. Turning right (+y) moves the world to the left in the image.
  const CameraModel camera;
  EgoMotion ego_motion({}, camera);
  const Eigen::Vector3d w(0, 2, 0);
  ego_motion.set_motion(w, kBeginUs, kEndUs);
  const double earlier_x = camera.project(rotation(w * 0.01) * ray(camera, 100, 120)).x();
  EXPECT_GT(earlier_x, 103);  // 10 ms ago it was farther right
  const Eigen::Vector2f warped = ego_motion.warp(
      {.t_us = kBeginUs, .x = static_cast<std::uint16_t>(std::lround(earlier_x)), .y = 120});
  EXPECT_NEAR(warped.x(), 100, 0.6);  // the rounding to whole pixels
}

TEST(EgoMotion, SwitchedOffItIgnoresTheRotation) {
  const CameraModel camera;
  EgoMotion ego_motion({.enabled = false}, camera);
  ego_motion.set_motion({3, 3, 3}, kBeginUs, kEndUs);
  const Eigen::Vector2f warped = ego_motion.warp({.t_us = kBeginUs, .x = 20, .y = 30});
  EXPECT_NEAR(warped.x(), 20, 1e-3);
  EXPECT_NEAR(warped.y(), 30, 1e-3);
}

TEST(EgoMotion, EventsOutsideOfTheWindowUseTheNearestTime) {
  const CameraModel camera;
  EgoMotion ego_motion({}, camera);
  ego_motion.set_motion({0, 5, 0}, kBeginUs, kEndUs);
  const auto u = [&](TimeUs t_us) { return ego_motion.warp({.t_us = t_us, .x = 9, .y = 9}).x(); };
  EXPECT_EQ(u(kBeginUs - 5000), u(kBeginUs));
  EXPECT_EQ(u(kEndUs + 5000), u(kEndUs));
}

}  // namespace
}  // namespace dodge
