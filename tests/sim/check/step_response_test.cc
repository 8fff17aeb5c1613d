// A step is answered as the low-passes, the latency and the jitter say, or the check fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/check/step_response.h"
#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

TEST(StepResponseCheck, FailsForAnotherBandwidth) {
  EventCameraSpec broken;
  broken.photoreceptor_hz *= 0.9;
  const Names failed = failures(judge(measure_step_response(broken, 1), EventCameraSpec()));
  EXPECT_TRUE(std::count(failed.begin(), failed.end(), "step.up.10_lux.median"));
  EXPECT_TRUE(std::count(failed.begin(), failed.end(), "step.up.100_lux.median"));
  EXPECT_TRUE(std::count(failed.begin(), failed.end(), "step.down.100_lux.median"));
  broken = EventCameraSpec();
  broken.follower_hz = 20000;
  EXPECT_FALSE(failures(judge(measure_step_response(broken, 1), EventCameraSpec())).empty());
}

TEST(StepResponseCheck, TellsTheThresholdsOfTheTwoDirectionsApart) {
  EventCameraSpec broken;
  broken.contrast_threshold_off = 0.22;
  const Names failed = failures(judge(measure_step_response(broken, 1), EventCameraSpec()));
  EXPECT_TRUE(std::count(failed.begin(), failed.end(), "step.down.100_lux.median"));
  EXPECT_FALSE(std::count(failed.begin(), failed.end(), "step.up.100_lux.median"));
}

TEST(StepResponseCheck, FailsForAnotherJitterAndLatency) {
  EventCameraSpec broken;
  broken.jitter_us = 13;
  const Names failed = failures(judge(measure_step_response(broken, 1), EventCameraSpec()));
  EXPECT_TRUE(std::count(failed.begin(), failed.end(), "step.up.10000_lux.spread"));
  broken = EventCameraSpec();
  broken.latency_us = 105;
  EXPECT_FALSE(failures(judge(measure_step_response(broken, 1), EventCameraSpec())).empty());
}

TEST(StepResponseCheck, KnowsWhatJitterDoesToTheMedianAndToSeveralEvents) {
  EventCameraSpec free = event_camera_preset("noisy");
  free.refractory_us = 0;
  for (const EventCameraSpec& spec : {event_camera_preset("noisy"), free}) {
    for (const std::uint64_t seed : {3, 5, 7, 8, 10}) {  // with less room for chance these failed
      EXPECT_EQ(failures(judge(measure_step_response(spec, seed), spec)), Names()) << seed;
    }
  }
}

TEST(StepResponseCheck, KnowsHowFewOfMostlyDeadPixelsAnswer) {
  EventCameraSpec spec;
  spec.dead_pixel_fraction = 0.9;
  for (const std::uint64_t seed : {1, 3}) {
    EXPECT_EQ(failures(judge(measure_step_response(spec, seed), spec)), Names()) << seed;
  }
}

TEST(StepResponseCheck, AllowsAMicrosecondForTheStepAndOneForTheStamp) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 3000;
  spec.contrast_threshold_on = 0.1;
  EXPECT_EQ(failures(judge(measure_step_response(spec, 1), spec)), Names());
}

TEST(StepResponseCheck, HasTheClosedFormOfOneAndTwoLowPasses) {
  EXPECT_DOUBLE_EQ(step_time_s(0.5, 100, 0), std::log(2) / 100);
  EXPECT_DOUBLE_EQ(step_time_s(0.5, 0, 100), std::log(2) / 100);
  EXPECT_EQ(step_time_s(0.5, 0, 0), 0);
  EXPECT_TRUE(std::isinf(step_time_s(1, 100, 50)));
  for (const auto& [a, b] : {std::pair{100.0, 70.0}, {100.0, 100.0}, {100.0, 9000.0}}) {
    const double t_s = step_time_s(0.3, a, b);
    // dz/dt = b (y - z), y = 1 - exp(-a t), in small steps.
    double z = 0;
    constexpr int kSteps = 100000;
    const double h = t_s / kSteps;
    for (int i = 0; i < kSteps; ++i) z += h * b * (1 - std::exp(-a * (i + 0.5) * h) - z);
    EXPECT_NEAR(z, 0.3, 1e-3);
  }
}

}  // namespace
}  // namespace dodgesim
