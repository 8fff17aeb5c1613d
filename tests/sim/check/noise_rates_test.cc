// Leak, shot noise and hot pixels come as often as the camera says, or the check fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/random.h"
#include "sim/check/noise_rates.h"
#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

// Each kind of noise is filmed by itself: where one is the subject, the others are off.
EventCameraSpec leak_only(EventCameraSpec spec) {
  spec.shot_noise_on_hz = spec.shot_noise_off_hz = spec.hot_pixel_hz = 0;
  return spec;
}
EventCameraSpec shot_only(EventCameraSpec spec) {
  spec.leak_hz = spec.hot_pixel_hz = 0;
  return spec;
}
EventCameraSpec hot_only(EventCameraSpec spec) {
  spec.leak_hz = spec.shot_noise_on_hz = spec.shot_noise_off_hz = 0;
  return spec;
}

TEST(NoiseCheck, FailsForOtherRates) {
  const auto failed = [](auto only, auto change) {
    EventCameraSpec broken = only(EventCameraSpec());
    change(broken);
    return failures(judge(measure_noise(broken, 1), EventCameraSpec()));
  };
  EXPECT_EQ(failed(leak_only, [](auto& spec) { spec.leak_hz *= 1.01; }), Names{"noise.leak.on"});
  EXPECT_EQ(failed(shot_only, [](auto& spec) { spec.shot_noise_on_hz *= 1.1; }),
            (Names{"noise.shot.dark.on", "noise.shot.bright.on"}));
  EXPECT_EQ(failed(shot_only, [](auto& spec) { spec.shot_noise_bright_share = 0.3; }),
            (Names{"noise.shot.bright.on", "noise.shot.bright.off"}));
  EXPECT_EQ(failed(hot_only, [](auto& spec) { spec.hot_pixel_hz *= 1.05; }),
            (Names{"noise.hot.rate", "noise.hot.above_mean"}));
  EXPECT_EQ(failed(hot_only, [](auto& spec) { spec.hot_pixel_fraction *= 2; }),
            Names{"noise.hot.pixels"});
  EXPECT_EQ(failed(hot_only, [](auto& spec) { spec.hot_pixel_sigma = 0.9; }),
            Names{"noise.hot.above_mean"});
  EventCameraSpec without_leak;
  without_leak.leak_hz = 0;
  EXPECT_EQ(failures(judge(measure_noise(leak_only(EventCameraSpec()), 1), without_leak)),
            Names{"noise.leak.on"});
}

TEST(NoiseCheck, FailsForShotNoiseThatDoesNotCareAboutThresholds) {
  NoiseCounts even = measure_noise(shot_only(EventCameraSpec()), 1);
  std::ranges::reverse(even.shot_dark.per_pixel_on);  // to pixels of other thresholds
  EXPECT_EQ(failures(judge(even, EventCameraSpec())), Names{"noise.shot.dark.by_threshold"});
}

TEST(NoiseCheck, KnowsHowOftenALeakComesThatIsHeldForLong) {
  EventCameraSpec spec;
  spec.leak_hz = 10;
  spec.refractory_us = 10000;
  EXPECT_EQ(failures(judge(measure_noise(spec, 1), spec)), Names());
}

TEST(NoiseCheck, KnowsThatALeaksPeriodGoesWithThePixelsThreshold) {
  EventCameraSpec spec;
  spec.leak_hz = 5;
  spec.refractory_us = 1000;
  spec.mismatch_sigma = 0.08;
  EXPECT_EQ(failures(judge(measure_noise(spec, 1), spec)), Names());
  spec = leak_only(spec);
  for (const std::uint64_t seed : {2, 3}) {
    EXPECT_EQ(failures(judge(measure_noise(spec, seed), spec)), Names()) << seed;
  }
}

TEST(NoiseCheck, ExpectsNoEventsOfAPolarityThatHasNone) {
  EventCameraSpec spec;
  spec.shot_noise_off_hz = 0;
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

TEST(NoiseCheck, FailsForEventsOfAnotherCause) {
  const EventCameraSpec spec;
  NoiseCounts counts = measure_noise(leak_only(spec), 1);
  counts.leak.other = 1;
  EXPECT_EQ(failures(judge(counts, spec)), Names{"noise.leak.other_causes"});
}

}  // namespace
}  // namespace dodgesim
