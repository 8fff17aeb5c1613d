#include "sim/events/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/sim/events/sampler_scene.h"

namespace dodgesim {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace)

TEST(Sampler, SamplesAtTheMinimumRateWhenNothingMoves) {
  Sampler sampler = sampler_for({});
  EXPECT_EQ(run(sampler, Snapshot(), 1.0, 20000), (std::vector<TimeUs>{5000, 10000, 15000, 20000}));
}

TEST(Sampler, SamplesExactlyWhenRequired) {
  Sampler sampler = sampler_for({});
  sampler.reset(0);
  sampler.require(3100);
  sampler.require(1000);
  sampler.require(1000);
  std::vector<Sample> samples;
  const auto go = [&](TimeUs from, TimeUs to) {
    for (TimeUs t = from; t < to; t += kTickUs) {
      sampler.advance(scene({}, t), scene({}, t + kTickUs), StaticDistances(1.0), samples);
    }
  };
  go(0, 4000);
  sampler.require(4001);
  sampler.require(2000);  // too late, and harmless
  go(4000, 10000);
  EXPECT_EQ(times_of(samples), (std::vector<TimeUs>{1000, 3100, 4001, 9001}));
}

TEST(Sampler, ARotationIsSampledByItsSpeedInTheCorners) {
  Snapshot start;
  start.vehicle.w_W = mounted_camera().linear() * Eigen::Vector3d(0, 3, 0);  // about y_C
  Sampler sampler = sampler_for({});
  const auto times = run(sampler, start, kFar, kLongest);
  const double interval_us = 1e6 * SamplingSpec().max_displacement_px / corner_speed(3);
  ASSERT_GT(times.size(), 9u);
  EXPECT_NEAR(static_cast<double>(times[8]) / 9, interval_us, 2);
}

TEST(Sampler, ATranslationIsSampledByTheNearestDepth) {
  Snapshot start;
  start.vehicle.v_W = mounted_camera().linear() * Eigen::Vector3d(2, 0, 0);  // along x_C
  Sampler sampler = sampler_for({});
  const auto times = run(sampler, start, 1.5, 50000);
  // A point at a distance of 1.5 m in the corner of the view has the least depth.
  const double secant = Eigen::Vector3d(160, 120, kIntrinsics.f).norm() / kIntrinsics.f;
  const double interval_us = 1e6 * 0.5 / (kIntrinsics.f * 2 * secant / 1.5);
  EXPECT_NEAR(static_cast<double>(times.back()) / static_cast<double>(times.size()), interval_us,
              2);
}

bool in_view(const Eigen::Vector3d& p_C) {
  if (p_C.z() <= 0) return false;
  const Eigen::Vector2d p = kIntrinsics.project(p_C);
  return p.x() >= -0.5 && p.x() <= kIntrinsics.width - 0.5 && p.y() >= -0.5 &&
         p.y() <= kIntrinsics.height - 0.5;
}

// Largest displacement between t0 and t1 of any of the points that is in view at t1.
template <class Point>
double displacement(const Snapshot& start, TimeUs t0, TimeUs t1, int count, const Point& point) {
  const Snapshot a = scene(start, t0);
  const Snapshot b = scene(start, t1);
  const Eigen::Isometry3d X_CW_a = (a.vehicle.pose() * mounted_camera()).inverse();
  const Eigen::Isometry3d X_CW_b = (b.vehicle.pose() * mounted_camera()).inverse();
  double largest = 0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d pa = X_CW_a * point(i, a, X_CW_b);
    const Eigen::Vector3d pb = X_CW_b * point(i, b, X_CW_b);
    if (!in_view(pb) || pa.z() <= 0) continue;
    largest = std::max(largest, (kIntrinsics.project(pb) - kIntrinsics.project(pa)).norm());
  }
  return largest;
}

TEST(Sampler, NoPointOfAnObjectMovesFartherThanTheLimitBetweenSamples) {
  RandomStream random(2, 0, "sampler");
  const double radius = 0.15;
  SamplingSpec spec;
  spec.min_interval_us = 1;
  std::vector<Eigen::Vector3d> surface;
  for (int i = 0; i < 200; ++i) surface.push_back(random_vector(random, radius));
  int seen = 0;
  double largest = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Snapshot start = random_scene(random);
    Sampler sampler = sampler_for({radius}, spec);
    const auto times = run(sampler, start, kFar, 30000);
    TimeUs previous = 0;
    for (const TimeUs t : times) {
      const double distance = (scene(start, t).objects[0].p_W - scene(start, t).vehicle.p_W).norm();
      if (distance > 0.5) {
        const double moved_px = displacement(
            start, previous, t, 200, [&](int i, const Snapshot& s, const Eigen::Isometry3d&) {
              return Eigen::Vector3d(s.objects[0].pose() * surface[static_cast<std::size_t>(i)]);
            });
        EXPECT_LE(moved_px, spec.max_displacement_px * 1.01);
        seen += moved_px > 0 ? 1 : 0;
        largest = std::max(largest, moved_px);
      }
      previous = t;
    }
  }
  EXPECT_GT(seen, 2000);
  EXPECT_GT(largest, 0.8 * spec.max_displacement_px);  // the bound is not idle either
}

TEST(Sampler, NoPointOfTheStaticSceneMovesFartherThanTheLimitBetweenSamples) {
  RandomStream random(3, 0, "sampler");
  SamplingSpec spec;
  spec.min_interval_us = 1;
  double largest = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Snapshot start = random_scene(random);
    Sampler sampler = sampler_for({}, spec);
    // Alike everywhere, or different in every part of the view.
    StaticDistances distances(1.0);
    for (double& m : distances.m) m = trial % 2 == 0 ? 1.0 : random.uniform(0.5, 5);
    const auto times = times_of(run_samples(sampler, start, distances, 10000));
    std::vector<Eigen::Vector3d> pixels;  // with the distance in place of z
    for (int i = 0; i < 150; ++i) {
      Eigen::Vector3d& p =
          pixels.emplace_back(random.uniform(-0.5, 319.5), random.uniform(-0.5, 239.5), 0);
      if (i % 5 == 0) p.head<2>() = Eigen::Vector2d(i % 2 == 0 ? -0.49 : 319.49, 239.49);
      const double nearest = distances.at(static_cast<int>((p.x() + 0.5) * 8 / 320),
                                          static_cast<int>((p.y() + 0.5) * 6 / 240));
      p.z() = i % 3 == 0 ? nearest : random.uniform(nearest, 8);
    }
    TimeUs previous = 0;
    for (const TimeUs t : times) {
      const double moved_px = displacement(
          start, previous, t, 150, [&](int i, const Snapshot&, const Eigen::Isometry3d& X_CW) {
            const Eigen::Vector3d& p = pixels[static_cast<std::size_t>(i)];
            const Eigen::Vector3d ray((p.x() - kIntrinsics.cx()) / kIntrinsics.f,
                                      (p.y() - kIntrinsics.cy()) / kIntrinsics.f, 1);
            return Eigen::Vector3d(X_CW.inverse() * (ray.normalized() * p.z()));
          });
      EXPECT_LE(moved_px, spec.max_displacement_px * 1.02);
      largest = std::max(largest, moved_px);
      previous = t;
    }
  }
  EXPECT_GT(largest, 0.95 * spec.max_displacement_px);
}

TEST(Sampler, AThrownBallCostsLittleMoreSamplesThanItsMotionNeeds) {
  // 10 m/s from 3 m straight at the camera: its outline grows by f r v/Z^2.
  Snapshot start;
  start.launched = {true};
  start.objects.resize(1);
  const Eigen::Isometry3d X_BC = mounted_camera();
  start.objects[0].p_W = X_BC * Eigen::Vector3d(0, 0, 3);
  start.objects[0].v_W = X_BC.linear() * Eigen::Vector3d(0, 0, -10);
  Sampler sampler = sampler_for({0.1});
  const double at_3m = sampler.object_speed(scene(start, 0), 0);
  const double at_1m = sampler.object_speed(scene(start, 200000), 0);
  EXPECT_NEAR(at_3m, kIntrinsics.f * 0.1 * 10 / 9, 0.1 * at_3m);
  EXPECT_NEAR(at_1m, kIntrinsics.f * 0.1 * 10 / 1, 0.2 * at_1m);
}

TEST(Sampler, ObjectsOutOfViewOrNotLaunchedDoNotCount) {
  Snapshot start;
  start.launched = {true};
  start.objects.resize(1);
  start.objects[0].v_W = Eigen::Vector3d(0, 8, 0);
  Sampler sampler = sampler_for({0.1});
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(-2, 0, 0), Eigen::Vector3d(2, 4, 0),
                                       Eigen::Vector3d(2, 0, 4), Eigen::Vector3d(1, -5, -5)}) {
    start.objects[0].p_W = place;
    EXPECT_EQ(sampler.object_speed(start, 0), 0);
  }
  start.objects[0].p_W = Eigen::Vector3d(2, 0, 0);
  EXPECT_GT(sampler.object_speed(start, 0), 500);
  start.launched = {false};
  EXPECT_EQ(sampler.object_speed(start, 0), 0);
}

TEST(Sampler, AnObjectThatFillsTheViewIsSampledAtTheMinimumInterval) {
  Snapshot start;
  start.launched = {true};
  start.objects.resize(1);
  start.objects[0].p_W = mounted_camera().translation();
  start.objects[0].v_W = Eigen::Vector3d(0, 0.5, 0);
  Sampler sampler = sampler_for({0.3});
  const auto times = run(sampler, start, kFar, 10000);
  EXPECT_EQ(times.size(), 40u);
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_EQ(times[i] - times[i - 1], 250);
}

TEST(Sampler, AFastTurnIsSampledAtTheMinimumInterval) {
  Snapshot start;
  start.vehicle.w_W = mounted_camera().linear() * Eigen::Vector3d(0, 30, 0);
  Sampler sampler = sampler_for({});
  EXPECT_EQ(run(sampler, start, kFar, 1000), (std::vector<TimeUs>{250, 500, 750, 1000}));
}

TEST(Sampler, RefusesLimitsThatAllowNoSampling) {
  SamplingSpec spec;
  spec.max_displacement_px = 0;
  EXPECT_THROW(sampler_for({}, spec), std::invalid_argument);
  spec = SamplingSpec();
  spec.min_interval_us = 0;
  EXPECT_THROW(sampler_for({}, spec), std::invalid_argument);
  spec = SamplingSpec();
  spec.min_rate_hz = 2e6;
  EXPECT_THROW(sampler_for({}, spec), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim
