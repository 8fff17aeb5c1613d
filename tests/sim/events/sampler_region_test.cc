// Samples of the region of an object.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim/events/sampler_scene.h"

namespace dodgesim {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace)

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

}  // namespace
}  // namespace dodgesim
