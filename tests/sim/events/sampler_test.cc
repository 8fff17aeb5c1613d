#include "sim/events/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "sim/base/random.h"
#include "tests/sim/events/moving_plane.h"

namespace dodgesim {
namespace {

using testing::MovingPlane;

const Intrinsics kIntrinsics;      // 320 x 240
constexpr TimeUs kLongest = 5000;  // 1/min_rate_hz of the default
const double kFar = 1e6;

// Camera in front of and above the vehicle's centre, looking along x_B, pitched down by 0.2 rad.
Eigen::Isometry3d mounted_camera() {
  Eigen::Isometry3d X = MovingPlane::X_BC();
  X.linear() = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) * X.linear();
  X.translation() = Eigen::Vector3d(0.1, 0.02, 0.075);
  return X;
}

// Bodies that move at constant velocities from their state at t = 0.
BodyState moved(const BodyState& start, TimeUs t_us) {
  BodyState s = start;
  s.p_W += start.v_W * seconds(t_us);
  const double angle = start.w_W.norm() * seconds(t_us);
  if (angle > 0) s.q_W = Eigen::AngleAxisd(angle, start.w_W.normalized()) * start.q_W;
  return s;
}

Snapshot scene(const Snapshot& start, TimeUs t_us) {
  Snapshot s = start;
  s.t_us = t_us;
  s.vehicle = moved(start.vehicle, t_us);
  for (std::size_t i = 0; i < s.objects.size(); ++i) s.objects[i] = moved(start.objects[i], t_us);
  return s;
}

std::vector<Sample> run_samples(Sampler& sampler, const Snapshot& start, double nearest_m,
                                TimeUs end_us) {
  std::vector<Sample> samples;
  sampler.reset(0);
  for (TimeUs t = 0; t < end_us; t += kTickUs) {
    sampler.advance(scene(start, t), scene(start, t + kTickUs), nearest_m, samples);
  }
  return samples;
}

std::vector<TimeUs> times_of(const std::vector<Sample>& samples) {
  std::vector<TimeUs> times;
  for (const Sample& sample : samples) times.push_back(sample.t_us);
  return times;
}

std::vector<TimeUs> run(Sampler& sampler, const Snapshot& start, double nearest_m, TimeUs end_us) {
  return times_of(run_samples(sampler, start, nearest_m, end_us));
}

Sampler sampler_for(std::vector<double> radii, const SamplingSpec& spec = SamplingSpec()) {
  return Sampler(spec, kIntrinsics, mounted_camera(), std::move(radii));
}

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
      sampler.advance(scene({}, t), scene({}, t + kTickUs), 1.0, samples);
    }
  };
  go(0, 4000);
  sampler.require(4001);
  sampler.require(2000);  // too late, and harmless
  go(4000, 10000);
  EXPECT_EQ(times_of(samples), (std::vector<TimeUs>{1000, 3100, 4001, 9001}));
}

SamplingSpec never_fast() {
  SamplingSpec spec;
  spec.fast_interval_us = 1;
  return spec;
}

// How far anything may move over an interval between two samples.
double limit_px(const SamplingSpec& spec, TimeUs interval_us) {
  return interval_us > spec.fast_interval_us ? spec.max_displacement_px : spec.fast_displacement_px;
}

// Speed of the corners of the image [px/s] when the camera turns about y_C.
double corner_speed(double rate_radps) {
  const double x = 160 / kIntrinsics.f;
  const double y = 120 / kIntrinsics.f;
  return rate_radps * kIntrinsics.f * std::hypot(1 + x * x, x * y);
}

TEST(Sampler, TheLimitIsWiderWhereSamplesAreCloseInTimeAnyway) {
  const SamplingSpec spec;
  const struct {
    double rate_radps, interval_us;
  } cases[] = {{0.5, 1e6 * spec.max_displacement_px / corner_speed(0.5)},
               {5, static_cast<double>(spec.fast_interval_us)},
               {9, 1e6 * spec.fast_displacement_px / corner_speed(9)}};
  for (const auto& c : cases) {
    Snapshot start;
    start.vehicle.w_W = mounted_camera().linear() * Eigen::Vector3d(0, c.rate_radps, 0);
    Sampler sampler = sampler_for({}, spec);
    const auto times = run(sampler, start, kFar, 50000);
    ASSERT_GT(times.size(), 2u);
    EXPECT_NEAR(static_cast<double>(times.back()) / static_cast<double>(times.size()),
                c.interval_us, 0.01 * c.interval_us)
        << c.rate_radps << " rad/s";
  }
}

TEST(Sampler, ARotationIsSampledByItsSpeedInTheCorners) {
  Snapshot start;
  start.vehicle.w_W = mounted_camera().linear() * Eigen::Vector3d(0, 3, 0);  // about y_C
  Sampler sampler = sampler_for({}, never_fast());
  const auto times = run(sampler, start, kFar, 50000);
  const double interval_us = 1e6 * SamplingSpec().max_displacement_px / corner_speed(3);
  ASSERT_GT(times.size(), 10u);
  EXPECT_NEAR(static_cast<double>(times.back()) / static_cast<double>(times.size()), interval_us,
              2);
}

TEST(Sampler, ATranslationIsSampledByTheNearestDepth) {
  Snapshot start;
  start.vehicle.v_W = mounted_camera().linear() * Eigen::Vector3d(2, 0, 0);  // along x_C
  Sampler sampler = sampler_for({}, never_fast());
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

Eigen::Vector3d random_vector(RandomStream& random, double length) {
  return length * Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

Snapshot random_scene(RandomStream& random) {
  Snapshot start;
  start.vehicle.v_W = random_vector(random, random.uniform(0, 5));
  start.vehicle.w_W = random_vector(random, random.uniform(0, 6));
  start.objects.resize(1);
  start.launched = {true};
  BodyState& object = start.objects[0];
  object.p_W =
      Eigen::Vector3d(random.uniform(0.6, 4), random.uniform(-4, 4), random.uniform(-3, 3));
  object.v_W = random_vector(random, random.uniform(0, 10)) - 0.8 * object.p_W;
  object.w_W = random_vector(random, random.uniform(0, 20));
  return start;
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
        EXPECT_LE(moved_px, limit_px(spec, t - previous) * 1.01);
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
  const double nearest = 1.0;
  double largest = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Snapshot start = random_scene(random);
    Sampler sampler = sampler_for({}, spec);
    const auto times = run(sampler, start, nearest, 10000);
    std::vector<Eigen::Vector3d> pixels;  // with the distance in place of z
    for (int i = 0; i < 150; ++i) {
      const double far = i % 3 == 0 ? nearest : random.uniform(nearest, 8);
      pixels.emplace_back(random.uniform(-0.5, 319.5), random.uniform(-0.5, 239.5), far);
      if (i % 5 == 0)
        pixels.back().head<2>() = Eigen::Vector2d(i % 2 == 0 ? -0.49 : 319.49, 239.49);
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
      EXPECT_LE(moved_px, limit_px(spec, t - previous) * 1.02);
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

// A ball that crosses the view of a camera at rest.
Snapshot crossing_ball(const Eigen::Vector3d& p_C, const Eigen::Vector3d& v_C) {
  Snapshot start;
  start.launched = {true};
  start.objects.resize(1);
  start.objects[0].p_W = mounted_camera() * p_C;
  start.objects[0].v_W = mounted_camera().linear() * v_C;
  return start;
}

TEST(Sampler, AFastObjectAsksForItsRegionAndNotForTheWholeImage) {
  Sampler sampler = sampler_for({0.1});
  const auto samples =
      run_samples(sampler, crossing_ball({-1, 0, 2}, {6, 0, 0}), 1.0, 4 * kLongest);
  std::vector<TimeUs> whole;
  int regions = 0;
  TimeUs previous = 0;
  for (const Sample& sample : samples) {
    EXPECT_GT(sample.t_us, previous);
    previous = sample.t_us;
    if (sample.object == Sample::kWholeImage) {
      whole.push_back(sample.t_us);
    } else {
      EXPECT_EQ(sample.object, 0);
      ++regions;
    }
  }
  EXPECT_EQ(whole, (std::vector<TimeUs>{5000, 10000, 15000, 20000}));
  // 600 px/s or a little more, half a pixel each.
  EXPECT_GT(regions, 20);
  EXPECT_LT(regions, 36);
}

TEST(Sampler, SamplesOfTheWholeImageComeAsIfThereWereNoObjects) {
  RandomStream random(4, 0, "sampler");
  for (int trial = 0; trial < 50; ++trial) {
    Snapshot start = random_scene(random);
    Sampler sampler = sampler_for({0.15});
    std::vector<TimeUs> whole;
    for (const Sample& sample : run_samples(sampler, start, 1.0, 20000)) {
      if (sample.object == Sample::kWholeImage) whole.push_back(sample.t_us);
    }
    start.launched = {false};
    const auto alone = run(sampler, start, 1.0, 20000);
    ASSERT_EQ(whole.size(), alone.size());
    // Sums of displacements round differently when there are more stops on the way.
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_LE(std::abs(whole[i] - alone[i]), static_cast<TimeUs>(i + 1));
    }
  }
}

TEST(Sampler, EveryPixelThatAnObjectEntersOrLeavesIsInTheSamplesBeforeAndAfter) {
  RandomStream random(5, 0, "sampler");
  const double radius = 0.15;
  int regions = 0;
  for (int trial = 0; trial < 25; ++trial) {
    Snapshot start = random_scene(random);
    start.vehicle.v_W *= 0.2;
    start.vehicle.w_W *= 0.2;
    // In view, at its border or just beside.
    const Eigen::Vector3d ray(random.uniform(-1, 1), random.uniform(-0.75, 0.75), 1);
    start.objects[0].p_W = mounted_camera() * Eigen::Vector3d(random.uniform(1.2, 3) * ray);
    start.objects[0].v_W = random_vector(random, random.uniform(3, 10));
    Sampler sampler = sampler_for({radius});
    const auto centre_C = [&](TimeUs t_us) {
      const Snapshot s = scene(start, t_us);
      return Eigen::Vector3d((s.vehicle.pose() * mounted_camera()).inverse() * s.objects[0].p_W);
    };
    // Which of the corners of a pixel are covered, as bits.
    const auto covered = [&](const Eigen::Vector3d& c, int x, int y) {
      int corners = 0;
      for (const double dx : {-0.5, 0.5}) {
        for (const double dy : {-0.5, 0.5}) {
          const Eigen::Vector3d ray(x + dx - kIntrinsics.cx(), y + dy - kIntrinsics.cy(),
                                    kIntrinsics.f);
          const double along = c.dot(ray);
          corners =
              2 * corners +
              (along > 0 && along * along > (c.squaredNorm() - radius * radius) * ray.squaredNorm()
                   ? 1
                   : 0);
        }
      }
      return corners;
    };
    Rect previous{0, 0, kIntrinsics.width, kIntrinsics.height};
    TimeUs previous_us = 0;
    for (const Sample& sample : run_samples(sampler, start, kFar, 8000)) {
      const Eigen::Vector3d a = centre_C(previous_us);
      const Eigen::Vector3d b = centre_C(sample.t_us);
      const Rect region = sampler.region(sample, scene(start, sample.t_us));
      const auto inside = [](const Rect& r, int x, int y) {
        return x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
      };
      for (int y = 0; y < kIntrinsics.height; ++y) {
        for (int x = 0; x < kIntrinsics.width; ++x) {
          if (inside(previous, x, y) && inside(region, x, y)) continue;
          ASSERT_EQ(covered(a, x, y), covered(b, x, y)) << trial << " " << sample.t_us;
        }
      }
      regions += !region.empty() && sample.object == 0 ? 1 : 0;
      previous = region;
      previous_us = sample.t_us;
    }
  }
  EXPECT_GT(regions, 200);
}

TEST(Sampler, ARegionHoldsThePlaceOfTheObjectInTheSampleBefore) {
  const Snapshot ball = crossing_ball({0, 0, 2}, {40, 0, 0});  // under-sampled
  for (const int before : {Sample::kWholeImage, 0}) {
    Sampler sampler = sampler_for({0.1});
    sampler.reset(0);
    const Rect first = sampler.region({1000, 0}, scene(ball, 1000));
    sampler.region({2000, before}, scene(ball, 2000));
    const Rect both = sampler.region({3000, 0}, scene(ball, 3000));
    const Rect third = sampler_for({0.1}).region({3000, 0}, scene(ball, 3000));
    EXPECT_EQ(both.x1, third.x1);
    EXPECT_NEAR(both.x0, first.x0 + kIntrinsics.f * 40 * 1e-3 / 2, 1);
    EXPECT_NEAR(third.x0, both.x0 + kIntrinsics.f * 40 * 1e-3 / 2, 1);
  }
}

TEST(Sampler, ARegionIsLittleLargerThanTheObject) {
  const Snapshot ball = crossing_ball({0, 0, 2}, {1, 0, 0});
  Sampler sampler = sampler_for({0.1});
  sampler.reset(0);
  const double outline_px = kIntrinsics.f * 0.1 / std::sqrt(4 - 0.01);
  const Rect region = sampler.region({250, 0}, scene(ball, 250));
  for (const int side : {region.x1 - region.x0, region.y1 - region.y0}) {
    EXPECT_GE(side, 2 * outline_px + 4);
    EXPECT_LE(side, 2 * outline_px + 4 + 2);
  }
  EXPECT_TRUE(sampler_for({0.1}).region({250, 0}, crossing_ball({5, 0, 2}, {0, 0, 0})).empty());
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
