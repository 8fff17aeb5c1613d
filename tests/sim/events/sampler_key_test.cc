// Which samples of the whole image are keys, which are drawn.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/events/sampler_scene.h"

namespace dodgesim {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace)

Snapshot turning(double rate_radps) {
  Snapshot start;
  start.vehicle.w_W = mounted_camera().linear() * Eigen::Vector3d(0, rate_radps, 0);  // about y_C
  return start;
}

std::vector<TimeUs> keys(const std::vector<Sample>& samples) {
  std::vector<TimeUs> times;
  for (const Sample& sample : samples) {
    if (sample.is_key()) times.push_back(sample.t_us);
  }
  return times;
}

SamplingSpec drifting() {
  SamplingSpec spec;
  spec.max_drift_px = 0.1;
  return spec;
}

TEST(SamplerKeys, EverySampleIsOneWhileSamplesAreFarApart) {
  Sampler sampler = sampler_for({});
  const auto samples = run_samples(sampler, turning(0.8), kFar, 10 * kLongest);
  EXPECT_GT(samples.size(), 20u);
  EXPECT_EQ(keys(samples), times_of(samples));
}

TEST(SamplerKeys, ACameraThatOnlyTurnsALittleNeedsNoneWhereDriftIsAllowed) {
  Sampler sampler = sampler_for({}, drifting());
  const auto samples = run_samples(sampler, turning(0.05), kFar, 10 * kLongest);
  EXPECT_EQ(samples.size(), 10u);
  EXPECT_TRUE(keys(samples).empty());
  for (const Sample& sample : samples) EXPECT_TRUE(sample.due);
}

TEST(SamplerKeys, WhatIsDueIsOneWhereTranslationMovesItFartherThanTheDrift) {
  const double limit_px = drifting().max_drift_px;
  const double ray = std::hypot(1, 160 / kIntrinsics.f, 120 / kIntrinsics.f);
  for (const double share : {0.9, 1.1}) {
    Snapshot start;
    const double speed_mps = share * limit_px / seconds(kLongest) / kIntrinsics.f / ray;
    start.vehicle.v_W = mounted_camera().linear() * Eigen::Vector3d(speed_mps, 0, 0);
    Sampler sampler = sampler_for({}, drifting());
    const auto samples = run_samples(sampler, start, 1.0, kLongest);
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0].is_key(), share > 1);
    EXPECT_TRUE(samples[0].due);
  }
}

TEST(SamplerKeys, ATurnIsMostlySeenBetweenThem) {
  Sampler sampler = sampler_for({});
  const auto samples = run_samples(sampler, turning(8), kFar, 10 * kLongest);
  EXPECT_GT(samples.size(), 100u);
  EXPECT_LE(keys(samples).size(), 11u);
}

TEST(SamplerKeys, NothingMovesFartherThanAPictureIsWiderBetweenThem) {
  for (const double rate : {10.0, 20.0, 40.0}) {
    Sampler sampler = sampler_for({});
    const auto times = keys(run_samples(sampler, turning(rate), kFar, 10 * kLongest));
    const double first_px = corner_speed(rate) * seconds(times.front());
    EXPECT_LE(first_px, SamplingSpec().max_turn_px * 1.001);
    if (rate > 15) {
      EXPECT_GT(first_px, 0.98 * SamplingSpec().max_turn_px);
    }
  }
}

TEST(SamplerKeys, ATranslationAsksForThem) {
  Snapshot start;
  start.vehicle.v_W = mounted_camera().linear() * Eigen::Vector3d(4, 0, 0);
  Sampler sampler = sampler_for({});
  // The corners are farther away than the centre by the length of their ray.
  constexpr double kNearest = 2;
  const double ray =
      std::sqrt(1 + std::pow(160 / kIntrinsics.f, 2) + std::pow(120 / kIntrinsics.f, 2));
  const double speed_pxps = kIntrinsics.f * 4 * ray / kNearest;
  const auto times = keys(run_samples(sampler, start, kNearest, 10 * kLongest));
  EXPECT_NEAR(static_cast<double>(times.front()), 1e6 * SamplingSpec().max_parallax_px / speed_pxps,
              2);
}

TEST(SamplerKeys, WhatIsRequiredIsDue) {
  Sampler sampler = sampler_for({});
  sampler.reset(0);
  sampler.require(1234);
  std::vector<Sample> samples;
  const Snapshot start = turning(8);
  for (TimeUs t = 0; t < 3000; t += kTickUs) {
    sampler.advance(scene(start, t), scene(start, t + kTickUs), kFar, samples);
  }
  int due = 0;
  for (const Sample& sample : samples) {
    if (!sample.due) continue;
    EXPECT_EQ(sample.t_us, 1234);
    ++due;
  }
  EXPECT_EQ(due, 1);
}

}  // namespace
}  // namespace dodgesim
