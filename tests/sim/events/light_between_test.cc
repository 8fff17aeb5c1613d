#include "sim/events/light_between.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/events/event_camera.h"

namespace dodgesim {
namespace {

const std::vector<float> kSteadyLight = {0.5F};

EventCameraSpec bandwidth_alone() {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 3000;
  spec.photoreceptor_dark_hz = 100;
  spec.illuminance_lux = 500;
  return spec;
}

TEST(LightBetween, HasNoLongStepsForACameraWithNoise) {
  EXPECT_EQ(LightBetween(event_camera_preset("ideal")).steps(100000000, kSteadyLight, kSteadyLight),
            1);
  EventCameraSpec leaking = event_camera_preset("ideal");
  leaking.leak_hz = 0.1;
  const LightBetween light(leaking);
  EXPECT_EQ(light.steps(1, kSteadyLight, kSteadyLight), 1);
  EXPECT_EQ(light.steps(50000, kSteadyLight, kSteadyLight), 1);
  EXPECT_EQ(light.steps(50001, kSteadyLight, kSteadyLight), 2);
  EXPECT_EQ(light.steps(100000000, kSteadyLight, kSteadyLight), 2000);
}

TEST(LightBetween, HasStepsOfLittleChangeOfTheBandwidth) {
  const LightBetween light(bandwidth_alone());
  const std::vector<float> before = {0.5F, 0.5F, 0.1F}, brighter = {0.5F, 0.6F, 0.6F},
                           darker = {0.5F, 0.6F, 0.02F};
  EXPECT_EQ(light.steps(10000, before, before), 1);
  // In the dark it is that of a luminance of 0.0667: ln(0.667 / 0.167) / ln 1.2 = 7.6.
  EXPECT_EQ(light.steps(10000, before, brighter), 8);
  EXPECT_EQ(light.steps(10000, brighter, before), 8);
  EXPECT_EQ(light.steps(10000, before, darker), 4);  // 3.6
  EXPECT_EQ(light.steps(3, before, darker), 3) << "no step is shorter than 1 us";
  EXPECT_EQ(LightBetween(event_camera_preset("ideal")).steps(10000, before, brighter), 1);
  EventCameraSpec blind_in_the_dark = bandwidth_alone();
  blind_in_the_dark.photoreceptor_dark_hz = 0;
  EXPECT_EQ(LightBetween(blind_in_the_dark).steps(10000, {0.0F}, {1.0F}), 100);
}

TEST(LightBetween, HasStepsOfLittleChangeOfTheShotNoise) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.shot_noise_on_hz = 1;
  spec.shot_noise_bright_share = 0.25;
  spec.illuminance_lux = 500;
  // A quarter at a luminance of 2: ln(1 / 0.25) / ln 1.2 = 7.6; 0.625 at 1: 2.6.
  EXPECT_EQ(LightBetween(spec).steps(10000, {0.0F}, {2.0F}), 8);
  EXPECT_EQ(LightBetween(spec).steps(10000, {9.0F}, {2.0F}), 1);
  EXPECT_EQ(LightBetween(spec).steps(10000, {1.0F}, {0.0F}), 3);
  spec.shot_noise_bright_share = 1;
  EXPECT_EQ(LightBetween(spec).steps(10000, {0.0F}, {2.0F}), 1);
}

// Of one pixel's fall or rise in 1 ms, with the light's bandwidth of every instant: a low-pass of
// first order in steps of 1 us.
std::vector<std::pair<double, int>> low_passed_light(const EventCameraSpec& spec, double from,
                                                     double to) {
  constexpr double kRiseUs = 1000, kEndUs = 100000;
  const double start = std::log(spec.log_epsilon + from), end = std::log(spec.log_epsilon + to);
  const auto response = [&](double t_us) {
    return start + (end - start) * std::min(1.0, t_us / kRiseUs);
  };
  std::vector<std::pair<double, int>> events;
  double signal = start, level = start;
  for (double t_us = 0; t_us < kEndUs; t_us += 1) {
    const double light = std::exp(response(t_us + 0.5)) - spec.log_epsilon;
    const double hz =
        spec.photoreceptor_dark_hz + spec.photoreceptor_hz * light * spec.illuminance_lux / 1000;
    const double before = signal;
    signal += (1 - std::exp(-2e-6 * std::numbers::pi * hz)) * (response(t_us + 0.5) - signal);
    for (const int sign : {-1, 1}) {
      const double c = sign > 0 ? spec.contrast_threshold_on : spec.contrast_threshold_off;
      while (sign * (signal - level) >= c) {
        level += sign * c;
        events.emplace_back(t_us + (level - before) / (signal - before), sign);
      }
    }
  }
  return events;
}

TEST(LightBetween, LetsBandwidthFollowTheLight) {
  const EventCameraSpec spec = bandwidth_alone();
  LightBetween light(spec);
  for (const auto& [from, to] : {std::pair{1.0F, 0.01F}, std::pair{0.05F, 0.8F}}) {
    EventCamera camera(spec, 1, 1, 1, 0, "test");
    const std::vector<float> before = {from}, after = {to};
    std::vector<Event> events;
    camera.reset(0, before.data());
    light.show_between(
        light.steps(1000, before, after), 0, before, 1000, after,
        [&](TimeUs at_us, const auto& seen) { camera.update(at_us, seen.data(), events); });
    camera.update(1000, after.data(), events);
    camera.update(100000, after.data(), events);
    const auto expected =
        low_passed_light(spec, static_cast<double>(from), static_cast<double>(to));
    ASSERT_EQ(events.size(), expected.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_EQ(events[i].polarity, expected[i].second);
      EXPECT_NEAR(static_cast<double>(events[i].t_us), expected[i].first,
                  10 + 0.01 * expected[i].first)
          << i;
    }
  }
}

TEST(LightBetween, MovesTheLogarithmOfEveryPixelLinearly) {
  const EventCameraSpec spec = event_camera_preset("ideal");
  const std::vector<float> before = {0, 0.5F, 2, 0.3F}, after = {1, 0.1F, 2, 0};
  std::vector<float> between;
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    LightBetween(spec).at(share, before, after, between);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double l = (1 - share) * std::log(1e-3 + before[i]) + share * std::log(1e-3 + after[i]);
      EXPECT_NEAR(between[i], std::exp(l) - 1e-3, 1e-6) << share << " " << i;
    }
    EXPECT_EQ(between[2], 2);
  }
}

// A picture is compared and mixed in pieces, each for the processor's vectors.
TEST(LightBetween, LooksAtEveryPixelOfAPicture) {
  const LightBetween light(bandwidth_alone());
  const std::vector<float> before(1000, 0.1F);
  std::vector<float> between;
  for (std::size_t i = 0; i < before.size(); i += 37) {
    std::vector<float> after = before;
    after[i] = 0.6F;
    EXPECT_EQ(light.steps(10000, before, after), 8) << i;
    light.at(0.5, before, after, between);
    for (std::size_t k = 0; k < before.size(); ++k) {
      if (k == i) {
        EXPECT_NEAR(between[k], std::sqrt(0.101 * 0.601) - 0.001, 1e-6) << k;
      } else {
        EXPECT_EQ(between[k], 0.1F) << k;
      }
    }
  }
}

TEST(LightBetween, RunsStraightWhereThePixelAnswersLinearly) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.linear_below = 1;
  std::vector<float> between;
  LightBetween(spec).at(0.25, {0.2F}, {0.6F}, between);
  EXPECT_NEAR(between[0], 0.3, 1e-6);
}

}  // namespace
}  // namespace dodgesim
