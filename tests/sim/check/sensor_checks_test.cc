// The self-tests pass for cameras that are what they are said to be, and fail for others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/random.h"
#include "sim/check/conservation.h"
#include "sim/check/convergence.h"
#include "sim/check/noise_rates.h"
#include "sim/check/readout_burst.h"
#include "sim/check/refractory.h"
#include "sim/check/self_tests.h"
#include "sim/check/stamps.h"
#include "sim/check/step_response.h"
#include "sim/check/thresholds.h"

namespace dodgesim {
namespace {

// Names of the lines with this outcome.
std::vector<std::string> lines(const Check& check, Outcome outcome) {
  std::vector<std::string> names;
  for (const CheckLine& line : check.lines) {
    if (line.outcome == outcome) names.push_back(line.name);
  }
  return names;
}

std::vector<std::string> failures(const Check& check) { return lines(check, Outcome::kFail); }

using Names = std::vector<std::string>;

class Preset : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Cameras, Preset, ::testing::Values("sees1", "ideal", "noisy", "low_light"),
                         [](const auto& info) { return info.param; });

TEST_P(Preset, PassesEveryCheck) {
  for (const auto& make_check : sensor_checks(event_camera_preset(GetParam()), 1)) {
    const Check check = make_check();
    EXPECT_EQ(failures(check), Names()) << check.title;
    EXPECT_FALSE(check.lines.empty()) << check.title;
  }
}

TEST(SensorChecks, OfACameraUnlikeThePresetsPass) {
  EventCameraSpec spec;
  spec.contrast_threshold_on = 0.35;
  spec.contrast_threshold_off = 0.15;
  spec.mismatch_sigma = 0.1;
  spec.follower_hz = 800;
  spec.refractory_us = 1000;
  spec.readout_max_hz = 5e5;
  spec.dead_pixel_fraction = 0.01;
  spec.linear_below = 0.01;
  for (const auto& make_check : sensor_checks(spec, 1)) {
    const Check check = make_check();
    EXPECT_EQ(failures(check), Names()) << check.title;
  }
}

TEST(SensorChecks, SayThatWhatIsSwitchedOffIsOff) {
  Names off;
  for (const auto& make_check : sensor_checks(ideal_event_camera(), 1)) {
    const Names names = lines(make_check(), Outcome::kOff);
    off.insert(off.end(), names.begin(), names.end());
  }
  EXPECT_EQ(off, (Names{"clock", "noise.leak", "noise.shot.dark", "noise.shot.bright", "noise.hot",
                        "readout.rate"}));
}

TEST(RefractoryCheck, FailsForAnotherPeriodAndForAnotherClock) {
  for (const std::int64_t refractory_us : {0, 100, 1000}) {
    for (const std::int64_t resolution_us : {1, 10, 250}) {
      EventCameraSpec spec;
      spec.refractory_us = refractory_us;
      spec.stamp_resolution_us = resolution_us;
      const RampEvents measured = measure_ramp(spec, 1);
      EXPECT_EQ(failures(judge(measured, spec)), Names()) << refractory_us << " " << resolution_us;
      EventCameraSpec longer = spec;
      longer.refractory_us = 2 * refractory_us + 10;
      EXPECT_EQ(failures(judge(measured, longer)).front(), "refractory.interval");
      EventCameraSpec finer = spec;
      finer.stamp_resolution_us = resolution_us + 70;
      EXPECT_FALSE(failures(judge(measured, finer)).empty());
    }
  }
}

TEST(RefractoryCheck, HoldsForCamerasThatAreLateSlowOrUneven) {
  EventCameraSpec late, slow, uneven;
  late.latency_us = 20000;
  slow.stamp_resolution_us = 20000;
  uneven.mismatch_sigma = 0.15;
  for (const EventCameraSpec& spec : {late, slow, uneven}) {
    EXPECT_EQ(failures(judge(measure_ramp(spec, 1), spec)), Names());
  }
}

TEST(RefractoryCheck, WaitsUntilTheLowPassesHaveSettled) {
  for (const char* preset : {"ideal", "sees1"}) {
    for (const double follower_hz : {10, 50, 100, 250}) {
      EventCameraSpec spec = event_camera_preset(preset);
      spec.follower_hz = follower_hz;
      const RampEvents measured = measure_ramp(spec, 1);
      const Check check = judge(measured, spec);
      EXPECT_EQ(failures(check), Names()) << preset << " " << follower_hz;
      EXPECT_EQ(check.lines.front().name, "refractory.interval");
      EventCameraSpec longer = spec;
      longer.refractory_us = 2 * spec.refractory_us + 20;
      EXPECT_EQ(failures(judge(measured, longer)).front(), "refractory.interval");
    }
  }
  EventCameraSpec dim = ideal_event_camera(), slowest = ideal_event_camera();
  dim.photoreceptor_hz = 1;
  dim.photoreceptor_dark_hz = 0.1;
  EXPECT_EQ(failures(judge(measure_ramp(dim, 1), dim)), Names());
  slowest.follower_hz = 0.001;
  EXPECT_EQ(lines(judge(measure_ramp(slowest, 1), slowest), Outcome::kOff),
            (Names{"refractory", "clock"}));
}

// Among them those that divide the time from one event to the next, 50 us.
TEST(RefractoryCheck, KnowsWhichWayAClockOfAnyResolutionRounds) {
  for (const std::int64_t resolution_us : {2, 7, 10, 25, 37, 50, 100, 333, 1000, 2000}) {
    EventCameraSpec spec = ideal_event_camera();
    spec.stamp_resolution_us = resolution_us;
    RampEvents measured = measure_ramp(spec, 1);
    const Check check = judge(measured, spec);
    EXPECT_EQ(failures(check), Names()) << resolution_us;
    EXPECT_EQ(check.lines.back().name, "clock.rounded_by");
    const auto step_us = static_cast<double>(resolution_us);
    RampEvents nearest = measured;
    for (double& late_us : nearest.rounded_by_us) late_us -= late_us > step_us / 2 ? step_us : 0;
    if (resolution_us > 2) {  // a half goes up
      EXPECT_EQ(failures(judge(nearest, spec)), Names{"clock.rounded_by"}) << resolution_us;
    }
    for (double& late_us : measured.rounded_by_us) late_us -= late_us > 0 ? step_us : 0;
    EXPECT_EQ(failures(judge(measured, spec)), Names{"clock.rounded_by"}) << resolution_us;
  }
}

TEST(ConservationCheck, FailsForAPixelBeyondItsThresholdUnlessItIsHeld) {
  const EventCameraSpec spec;
  PixelsAfterFilm after = measure_conservation(spec, 1);
  PixelState& pixel = after.pixels.at(777);
  ASSERT_FALSE(pixel.held);
  pixel.signal = pixel.reference + 1.01 * pixel.threshold_on;
  EXPECT_EQ(failures(judge(after, spec)), Names{"conservation.beyond"});
  pixel.held = true;
  EXPECT_EQ(failures(judge(after, spec)), Names());
  pixel.held = false;
  pixel.signal = pixel.reference - 1.01 * pixel.threshold_off;
  EXPECT_EQ(failures(judge(after, spec)), Names{"conservation.beyond"});
}

TEST(ConservationCheck, FailsForAPixelThatHasFallenSilent) {
  const EventCameraSpec spec;
  PixelsAfterFilm after = measure_conservation(spec, 1);
  after.answered.at(777) = false;
  EXPECT_EQ(failures(judge(after, spec)), Names{"conservation.stuck"});
}

TEST(ConservationCheck, FailsForTooManyDeadPixels) {
  EventCameraSpec broken;
  broken.dead_pixel_fraction = 0.002;
  EXPECT_EQ(failures(judge(measure_conservation(broken, 1), EventCameraSpec())),
            Names{"conservation.dead"});
}

TEST(ThresholdCheck, FailsForOtherThresholds) {
  EventCameraSpec broken;
  broken.contrast_threshold_on = 0.202;
  EXPECT_EQ(failures(judge(measure_thresholds(broken, 1), EventCameraSpec())),
            Names{"threshold.on.mean"});
  broken = EventCameraSpec();
  broken.contrast_threshold_off = 0.198;
  EXPECT_EQ(failures(judge(measure_thresholds(broken, 1), EventCameraSpec())),
            Names{"threshold.off.mean"});
}

TEST(ThresholdCheck, FailsForAnotherMismatch) {
  EventCameraSpec broken;
  broken.mismatch_sigma = 0.032;
  EXPECT_EQ(failures(judge(measure_thresholds(broken, 1), EventCameraSpec())),
            (Names{"threshold.on.sd", "threshold.off.sd"}));
}

TEST(ThresholdCheck, KnowsThatThresholdsAreCut) {
  // Against sums over quantiles.
  for (const double lowest : {-5.0, 0.0, 0.1, 0.25, 2.0}) {
    double mean = 0, square = 0;
    constexpr int kCount = 200000;
    for (int i = 0; i < kCount; ++i) {
      const double x = std::max(lowest, 0.2 + 0.1 * normal_quantile((i + 0.5) / kCount));
      mean += x / kCount;
      square += x * x / kCount;
    }
    const Moments moments = clipped_normal(0.2, 0.1, lowest);
    EXPECT_NEAR(moments.mean, mean, 1e-6);
    EXPECT_NEAR(moments.sd, std::sqrt(std::max(0.0, square - mean * mean)), 1e-4);
  }
  EXPECT_EQ(clipped_normal(0.2, 0, 0.3).mean, 0.3);
  EXPECT_EQ(clipped_normal(0.2, 0, 0.3).sd, 0);
}

TEST(StampCheck, FailsForStampsThatClump) {
  StampPhases phases = measure_stamps(EventCameraSpec(), 1);
  ASSERT_EQ(failures(judge(phases)), Names());
  ASSERT_GT(phases.phases.size(), 10000u);
  StampPhases clumped = phases;
  for (std::size_t i = 0; i < clumped.phases.size(); i += 10) clumped.phases[i] = 0.999;
  const Names failed = failures(judge(clumped));
  EXPECT_EQ(failed, (Names{"stamps.at_samples", "stamps.fullest_bin"}));
  // Equal slots, as of a simulator that spreads each picture's events over four instants.
  for (double& phase : phases.phases) phase = (std::floor(4 * phase) + 0.5) / 4;
  EXPECT_EQ(failures(judge(phases)).size(), 3u);
}

TEST(StampCheck, IsOffWithoutEvents) {
  EXPECT_EQ(lines(judge(StampPhases()), Outcome::kOff), Names{"stamps"});
}

TEST(ConvergenceCheck, FailsForEventsThatDependOnTheSampling) {
  const std::vector<Sampled> good = measure_convergence(EventCameraSpec(), 1);
  ASSERT_EQ(good.at(2).displacement_px, 0.5);
  std::vector<Sampled> broken = good;
  broken[2].difference.count_ratio = 0.985;
  EXPECT_EQ(failures(judge(broken)), Names{"convergence.0.500px.count"});
  broken = good;
  broken[2].difference.median_us = 60;
  EXPECT_EQ(failures(judge(broken)), Names{"convergence.0.500px.stamps"});
  broken = good;
  broken[2].difference.matched = 0.8;
  EXPECT_EQ(failures(judge(broken)), Names{"convergence.0.500px.matched"});
}

TEST(ConvergenceCheck, SeesTheErrorGrowWithTheDisplacement) {
  const std::vector<Sampled> rates = measure_convergence(ideal_event_camera(), 1);
  for (std::size_t i = 1; i < rates.size(); ++i) {
    EXPECT_LT(rates[i].difference.count_ratio, rates[i - 1].difference.count_ratio);
    EXPECT_GE(rates[i].difference.median_us, rates[i - 1].difference.median_us);
  }
}

TEST(StepResponseCheck, FailsForAnotherBandwidth) {
  EventCameraSpec broken;
  broken.photoreceptor_hz *= 0.9;
  const Names failed = failures(judge(measure_step_response(broken, 1), EventCameraSpec()));
  EXPECT_TRUE(std::count(failed.begin(), failed.end(), "step.10_lux.median"));
  EXPECT_TRUE(std::count(failed.begin(), failed.end(), "step.100_lux.median"));
  broken = EventCameraSpec();
  broken.follower_hz = 20000;
  EXPECT_FALSE(failures(judge(measure_step_response(broken, 1), EventCameraSpec())).empty());
}

TEST(StepResponseCheck, FailsForAnotherJitterAndLatency) {
  EventCameraSpec broken;
  broken.jitter_us = 13;
  const Names failed = failures(judge(measure_step_response(broken, 1), EventCameraSpec()));
  EXPECT_TRUE(std::count(failed.begin(), failed.end(), "step.10000_lux.spread"));
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

TEST(NoiseCheck, FailsForOtherRates) {
  const auto failed = [](auto change) {
    EventCameraSpec broken;
    change(broken);
    return failures(judge(measure_noise(broken, 1), EventCameraSpec()));
  };
  EXPECT_EQ(failed([](auto& spec) { spec.leak_hz *= 1.01; }), Names{"noise.leak.on"});
  EXPECT_EQ(failed([](auto& spec) { spec.shot_noise_on_hz *= 1.1; }),
            (Names{"noise.shot.dark.on", "noise.shot.bright.on"}));
  EXPECT_EQ(failed([](auto& spec) { spec.shot_noise_bright_share = 0.3; }),
            (Names{"noise.shot.bright.on", "noise.shot.bright.off"}));
  EXPECT_EQ(failed([](auto& spec) { spec.hot_pixel_hz *= 1.05; }), Names{"noise.hot.rate"});
  EXPECT_EQ(failed([](auto& spec) { spec.hot_pixel_fraction *= 2; }), Names{"noise.hot.pixels"});
  EventCameraSpec without_leak;
  without_leak.leak_hz = 0;
  EXPECT_EQ(failures(judge(measure_noise(EventCameraSpec(), 1), without_leak)),
            Names{"noise.leak.on"});
}

TEST(NoiseCheck, KnowsHowOftenALeakComesThatIsHeldForLong) {
  EventCameraSpec spec;
  spec.leak_hz = 10;
  spec.refractory_us = 10000;
  EXPECT_EQ(failures(judge(measure_noise(spec, 1), spec)), Names());
}

TEST(NoiseCheck, KnowsHowManyEventsAHoldLeaves) {
  RandomStream random(1, 0, "renewal");
  const struct {
    double rate_hz, hold_s, duration_s;
  } cases[] = {{0.3, 1, 5}, {3, 1, 5}, {50, 0.1, 5}, {2000, 0.01, 0.5}, {10, 0, 1}, {20, 0.005, 1}};
  for (const auto& c : cases) {
    constexpr int kPixels = 20000;
    double sum = 0, square = 0;
    for (int i = 0; i < kPixels; ++i) {
      int events = 0;
      const auto wait_s = [&] { return -std::log(random.uniform(1e-300, 1)) / c.rate_hz; };
      for (double t_s = wait_s(); t_s < c.duration_s; t_s += c.hold_s + wait_s()) ++events;
      sum += events;
      square += events * events;
    }
    const double mean = sum / kPixels;
    const double standard_error = std::sqrt((square / kPixels - mean * mean) / kPixels);
    EXPECT_NEAR(events_expected(c.rate_hz, c.hold_s, c.duration_s), mean, 4 * standard_error);
  }
  EXPECT_EQ(events_expected(0, 1, 5), 0);
}

// Whoever films a sensor with such settings is told what cannot be checked, and nothing false.
TEST(SensorChecks, OfExtremeCamerasPassOrAreOff) {
  const auto failed = [](auto change) {
    EventCameraSpec spec;
    change(spec);
    Names names;
    for (const auto& make_check : sensor_checks(spec, 1)) {
      for (const std::string& name : failures(make_check())) names.push_back(name);
    }
    return names;
  };
  EXPECT_EQ(failed([](auto& spec) { spec.refractory_us = 300000; }), Names());
  EXPECT_EQ(failed([](auto& spec) { spec.latency_us = 99000; }), Names());
  EXPECT_EQ(failed([](auto& spec) { spec.log_epsilon = 1000; }), Names());
  EXPECT_EQ(failed([](auto& spec) { spec.linear_below = 10; }), Names());
  EXPECT_EQ(failed([](auto& spec) { spec.dead_pixel_fraction = 1; }), Names());
  EXPECT_EQ(failed([](auto& spec) { spec.jitter_us = 5000; }), Names());
  EXPECT_EQ(failed([](auto& spec) { spec.shot_noise_on_hz = 1000; }), Names());
  EXPECT_EQ(failed([](auto& spec) {
              spec.hot_pixel_fraction = 0.2;
              spec.hot_pixel_hz = 20000;
            }),
            Names());
}

TEST(NoiseCheck, FailsForEventsOfAnotherCause) {
  const EventCameraSpec spec;
  NoiseCounts counts = measure_noise(spec, 1);
  counts.leak.other = 1;
  EXPECT_EQ(failures(judge(counts, spec)), Names{"noise.leak.other_causes"});
}

TEST(ReadoutCheck, IsOffForAReadoutThatIsTooSlowForAFilm) {
  EventCameraSpec spec;
  spec.readout_max_hz = 0.001;
  EXPECT_EQ(lines(judge(measure_burst(spec, 1), spec), Outcome::kOff), Names{"readout.rate"});
}

TEST(ReadoutCheck, FailsForAnotherRate) {
  EventCameraSpec broken;
  broken.readout_max_hz *= 1.02;
  EXPECT_EQ(failures(judge(measure_burst(broken, 1), EventCameraSpec())), Names{"readout.burst"});
  broken.readout_max_hz = 3e5;
  EventCameraSpec slow = broken;
  slow.readout_max_hz = 2.9e5;
  EXPECT_EQ(failures(judge(measure_burst(broken, 1), broken)), Names());
  EXPECT_EQ(failures(judge(measure_burst(broken, 1), slow)), Names{"readout.burst"});
}

TEST(ReadoutCheck, FailsForLossesThatAreNotCounted) {
  const EventCameraSpec spec;
  Burst burst = measure_burst(spec, 1);
  burst.second_delivered -= 1;
  EXPECT_EQ(failures(judge(burst, spec)), Names{"readout.second.not_counted"});
  burst = measure_burst(spec, 1);
  burst.lost = 1;
  EXPECT_EQ(failures(judge(burst, spec)), Names{"readout.lost"});
}

}  // namespace
}  // namespace dodgesim
