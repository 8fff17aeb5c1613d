#include "sim/events/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "tests/sim/events/dark_events.h"

namespace dodgesim {
namespace {

using testing::emulate;
using testing::every;
using testing::film;

using testing::dark_events;
using testing::kFieldHeight;
using testing::kFieldPixels;
using testing::kFieldWidth;

EventCameraSpec only_shot_noise() {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.shot_noise_on_hz = 0.235;
  spec.shot_noise_off_hz = 0.200;
  spec.shot_noise_bright_share = 1;  // the same at any light
  return spec;
}

// Leak events of a film, by half seconds.
std::vector<double> leaks_in_half_seconds(EventCamera& camera, const testing::Frames& frames) {
  const std::vector<Cause> scene(static_cast<std::size_t>(kFieldPixels), kCauseScene);
  std::vector<double> counts(static_cast<std::size_t>(frames.back().t_us / 500000));
  camera.reset(0, Picture{frames.front().luminance.data(), scene.data()});
  for (std::size_t i = 1; i < frames.size(); ++i) {
    std::vector<Event> events;
    camera.update(frames[i].t_us, Picture{frames[i].luminance.data(), scene.data()}, events);
    for (const Cause cause : camera.causes()) {
      if (cause == kCauseLeak) ++counts[static_cast<std::size_t>((frames[i].t_us - 1) / 500000)];
    }
  }
  return counts;
}

TEST(ShotNoise, HasTheSetRatesOfBothPolarities) {
  const EventCameraSpec spec = only_shot_noise();
  const double duration_s = 60;
  const auto events = dark_events(spec, every(5000000, 60000000));
  double on = 0;
  for (const Event& event : events) on += event.polarity > 0 ? 1 : 0;
  const double off = static_cast<double>(events.size()) - on;
  const double expected_on = spec.shot_noise_on_hz * kFieldPixels * duration_s;
  const double expected_off = spec.shot_noise_off_hz * kFieldPixels * duration_s;
  EXPECT_NEAR(on, expected_on, 3 * std::sqrt(expected_on));
  EXPECT_NEAR(off, expected_off, 3 * std::sqrt(expected_off));
}

TEST(Noise, DoesNotDependOnTheInstantsOfSampling) {
  EventCameraSpec spec;
  for (const double leak_hz : {0.0, 0.1}) {
    spec.leak_hz = leak_hz;
    if (leak_hz > 0) spec.jitter_us = 0;  // depends on the microsecond
    const auto coarse = dark_events(spec, every(100000, 1000000));
    ASSERT_GT(coarse.size(), 1000u);
    for (const auto& times :
         {every(100, 1000000), {0, 1, 17, 3000, 3001, 250000, 999999, 1000000}}) {
      const auto other = dark_events(spec, times);
      ASSERT_EQ(other.size(), coarse.size());
      for (std::size_t i = 0; i < coarse.size(); ++i) {
        // A leak event that rounds to the instant of a sample is stamped after it.
        const TimeUs slack_us = leak_hz > 0 ? 1 : 0;
        EXPECT_LE(std::abs(other[i].t_us - coarse[i].t_us), slack_us);
        EXPECT_EQ(std::tie(other[i].x, other[i].y, other[i].polarity),
                  std::tie(coarse[i].x, coarse[i].y, coarse[i].polarity));
      }
    }
  }
}

TEST(PoissonEvents, IsPoissonInTimeAndUniformOverThePixels) {
  std::vector<PixelRate> rates;
  for (std::uint32_t i = 0; i < 100; ++i) rates.push_back({i, 1.0, 1.0});
  PoissonEvents activity(RandomStream(3, 0, "test"), rates);
  std::vector<PoissonEvent> events;
  activity.take_until(100000000, events);
  const auto n = static_cast<double>(events.size());
  EXPECT_NEAR(n, 20000, 3 * std::sqrt(20000.0));
  double mean = 0, square = 0, long_waits = 0;
  std::map<std::uint32_t, int> per_pixel;
  TimeUs previous = 0;
  for (const PoissonEvent& event : events) {
    const double wait = static_cast<double>(event.t_us - previous) / 5000;  // in mean waiting times
    mean += wait / n;
    square += wait * wait / n;
    long_waits += wait > 2 ? 1 / n : 0;
    previous = event.t_us;
    ++per_pixel[event.pixel];
  }
  EXPECT_NEAR(mean, 1, 3 / std::sqrt(n));
  EXPECT_NEAR(square, 2, 3 * std::sqrt(20 / n));
  EXPECT_NEAR(long_waits, std::exp(-2.0), 3 * std::sqrt(0.117 / n));
  double chi_square = 0;
  for (std::uint32_t i = 0; i < 100; ++i)
    chi_square += std::pow(per_pixel[i] - n / 100, 2) / (n / 100);
  EXPECT_NEAR(chi_square, 99, 3 * std::sqrt(2 * 99.0));
}

TEST(PoissonEvents, OfTheSmallestRatesDoNotComeWithinTheClock) {
  for (const double rate_hz : {1e-20, 1e-300}) {
    PoissonEvents activity(RandomStream(3, 0, "test"), {{7, rate_hz, rate_hz}});
    std::vector<PoissonEvent> events;
    activity.take_until(TimeUs{1} << 50, events);
    EXPECT_TRUE(events.empty());
  }
}

TEST(PoissonEvents, GivesEachListedPixelAndPolarityItsRate) {
  const std::vector<PixelRate> rates = {{7, 10, 0}, {3, 0, 0}, {5, 2, 30}};
  PoissonEvents activity(RandomStream(3, 0, "test"), rates);
  std::vector<PoissonEvent> events;
  activity.take_until(1000000000, events);
  std::map<std::pair<std::uint32_t, bool>, double> count;
  for (const PoissonEvent& event : events) ++count[{event.pixel, event.on}];
  EXPECT_EQ(count.size(), 3u);
  EXPECT_NEAR((count[{7, true}]), 10000, 3 * std::sqrt(10000.0));
  EXPECT_NEAR((count[{5, true}]), 2000, 3 * std::sqrt(2000.0));
  EXPECT_NEAR((count[{5, false}]), 30000, 3 * std::sqrt(30000.0));
}

TEST(ShotNoise, IsInInverseProportionToThePixelsThresholdsAndSparesDeadPixels) {
  EventCameraSpec spec = only_shot_noise();
  spec.mismatch_sigma = 0.06;
  spec.dead_pixel_fraction = 0.1;
  const double duration_s = 200;
  EventCamera camera(spec, kFieldWidth, kFieldHeight, 1, 0, "top");
  const auto events = emulate(camera, film(kFieldWidth, kFieldHeight, every(10000000, 200000000),
                                           [](int, int, TimeUs) { return 0.2; }));
  std::vector<double> count(static_cast<std::size_t>(kFieldPixels));
  for (const Event& event : events) {
    count[std::size_t{event.y} * kFieldWidth + event.x] += event.polarity < 0 ? 1 : 0;
  }
  // If the rate is k/threshold, count x threshold has the same mean k T in any group of pixels.
  double low_sum = 0, high_sum = 0, low_square = 0, high_square = 0, low = 0, high = 0;
  double alive = 0, inverse = 0;
  for (int y = 0; y < kFieldHeight; ++y) {
    for (int x = 0; x < kFieldWidth; ++x) {
      const double threshold = camera.pixel(x, y).threshold_off;
      const double n = count[static_cast<std::size_t>(y * kFieldWidth + x)];
      if (std::isinf(threshold)) {
        EXPECT_EQ(n, 0);
        continue;
      }
      ++alive;
      inverse += 1 / threshold;
      const bool is_low = threshold < 0.2;
      (is_low ? low : high) += 1;
      (is_low ? low_sum : high_sum) += n * threshold;
      (is_low ? low_square : high_square) += n * threshold * n * threshold;
    }
  }
  EXPECT_LT(alive, 0.95 * kFieldPixels);
  const double expected = spec.shot_noise_off_hz * duration_s * alive / inverse;
  const double low_mean = low_sum / low, high_mean = high_sum / high;
  EXPECT_NEAR(low_mean, expected,
              3 * std::sqrt(low_square / low - low_mean * low_mean) / std::sqrt(low));
  EXPECT_NEAR(high_mean, expected,
              3 * std::sqrt(high_square / high - high_mean * high_mean) / std::sqrt(high));
}

TEST(ShotNoise, DiffersBetweenCamerasThrowsAndSeedsAndIsTheSameOtherwise) {
  const EventCameraSpec spec = only_shot_noise();
  const auto times = every(100000, 1000000);
  const auto events = dark_events(spec, times);
  EXPECT_EQ(dark_events(spec, times), events);
  const auto common = [&](const std::vector<Event>& other) {
    std::vector<Event> both;
    std::set_intersection(events.begin(), events.end(), other.begin(), other.end(),
                          std::back_inserter(both), testing::event_order);
    return both.size();
  };
  ASSERT_GT(events.size(), 1000u);
  EXPECT_LT(common(dark_events(spec, times, 2)), 3u);
  EXPECT_LT(common(dark_events(spec, times, 1, 1)), 3u);
  EXPECT_LT(common(dark_events(spec, times, 1, 0, "bottom")), 3u);
}

TEST(ShotNoise, ResetsThePixelItHits) {
  // L falls by 0.3 in all. A pixel hit by chance in the last 60 ms has less than a threshold to go
  // from there, so at the end its reference still is the L at that instant.
  EventCameraSpec spec = only_shot_noise();
  spec.shot_noise_on_hz = 50;
  spec.shot_noise_off_hz = 0;
  for (const int refractory_us : {0, 100}) {
    spec.refractory_us = refractory_us;
    EventCamera camera(spec, kFieldWidth, kFieldHeight, 1, 0, "top");
    const auto l = [](TimeUs t) { return std::exp(-0.3 * seconds(t) / 0.1); };
    const auto events = emulate(camera, film(kFieldWidth, kFieldHeight, every(1000, 100000),
                                             [&](int, int, TimeUs t) { return l(t); }));
    std::map<std::pair<int, int>, TimeUs> last_on;
    for (const Event& event : events) {
      if (event.polarity > 0) last_on[{event.x, event.y}] = event.t_us;
    }
    ASSERT_GT(last_on.size(), 2000u);
    for (const auto& [pixel, t_us] : last_on) {
      const PixelState state = camera.pixel(pixel.first, pixel.second);
      if (state.held || t_us < 40000) continue;
      const double since = static_cast<double>(t_us + refractory_us);
      const double expected = std::log(spec.log_epsilon + l(0) * std::exp(-3e-6 * since));
      EXPECT_NEAR(state.reference, expected, 1e-4);
    }
  }
}

TEST(ShotNoise, FallsLinearlyWithTheLightToItsShareAt1000Lux) {
  EventCameraSpec spec = only_shot_noise();
  spec.shot_noise_bright_share = 0.25;
  spec.illuminance_lux = 500;
  const struct { double luminance, share; } cases[] = {{0, 1}, {1, 0.625}, {2, 0.25}, {50, 0.25}};
  for (const auto& [luminance, share] : cases) {
    EventCamera camera(spec, kFieldWidth, kFieldHeight, 1, 0, "top");
    const double light = luminance;
    const auto events = emulate(camera, film(kFieldWidth, kFieldHeight, every(1000000, 20000000),
                                             [&](int, int, TimeUs) { return light; }));
    const double expected = share * 0.435 * kFieldPixels * 20;
    EXPECT_NEAR(static_cast<double>(events.size()), expected, 3 * std::sqrt(expected));
  }
}

TEST(Leak, MakesOnEventsAtTheSetMeanRateWhateverTheMismatch) {
  for (const double mismatch : {0.0, 0.03}) {
    EventCameraSpec spec = event_camera_preset("ideal");
    spec.mismatch_sigma = mismatch;
    spec.leak_hz = 2;
    const double duration_s = 10;
    const auto events = dark_events(spec, every(100000, 10000000));
    std::map<std::pair<int, int>, std::vector<TimeUs>> stamps;
    for (const Event& event : events) {
      EXPECT_EQ(event.polarity, 1);
      stamps[{event.x, event.y}].push_back(event.t_us);
    }
    // Pixels start anywhere between two events, and then are regular: each count is that of a
    // uniform phase, within one of its mean.
    const double expected = 2 * duration_s * kFieldPixels;
    EXPECT_NEAR(static_cast<double>(events.size()), expected,
                3 * std::sqrt(0.25 * kFieldPixels) + 1);
    EXPECT_EQ(stamps.size(), kFieldPixels);
    for (const auto& [pixel, times] : stamps) {
      const TimeUs period_us = times[1] - times[0];
      if (mismatch == 0) {
        EXPECT_NEAR(static_cast<double>(period_us), 500000, 2);
      }
      for (std::size_t i = 2; i < times.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(times[i] - times[i - 1]), static_cast<double>(period_us),
                    3);
      }
    }
    // No common beat: first events come evenly over the first period.
    double early = 0;
    for (const auto& [pixel, times] : stamps) early += times[0] < 250000;
    EXPECT_NEAR(early, 0.5 * kFieldPixels, 4 * std::sqrt(0.25 * kFieldPixels));
  }
}

// Noise resets pixels, the leak those that it has spared for a whole period: a renewal process,
// whose rates are the same from the first instant on.
TEST(Leak, IsAsAfterALongRestFromTheStartWhateverTheNoise) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.leak_hz = 1;
  spec.shot_noise_bright_share = 1;
  spec.hot_pixel_hz = 8;
  spec.hot_pixel_sigma = 0;
  for (const double noise_hz : {0.0, 0.5, 2.0}) {
    for (const double hot_share : {0.0, 1.0}) {
      spec.shot_noise_on_hz = spec.shot_noise_off_hz = 0.5 * noise_hz;
      spec.hot_pixel_fraction = hot_share;
      const double rate_hz = noise_hz + hot_share * spec.hot_pixel_hz;
      const double leaks_hz = rate_hz > 0 ? rate_hz / std::expm1(rate_hz) : 1;  // a period is 1 s
      EventCamera camera(spec, kFieldWidth, kFieldHeight, 1, 0, "top", true);
      const auto frames = film(kFieldWidth, kFieldHeight, every(100000, 4000000),
                               [](int, int, TimeUs) { return 0.2; });
      const double expected = leaks_hz * kFieldPixels * 0.5;
      const std::vector<double> leaks = leaks_in_half_seconds(camera, frames);
      for (const double count : {leaks.front(), leaks.back()}) {
        EXPECT_NEAR(count, expected, 4 * std::sqrt(expected) + 1) << noise_hz << " " << hot_share;
      }
    }
  }
}

TEST(Leak, AddsToARisingSignalAndHoldsUpAFallingOne) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.leak_hz = 10;  // 2 of log luminance in a second
  const auto count = [&](double slope) {
    EventCamera camera(spec, kFieldWidth, kFieldHeight, 1, 0, "top");
    return static_cast<double>(
               emulate(camera, film(kFieldWidth, kFieldHeight, every(10000, 1000000),
                                    [&](int, int, TimeUs t) {
                                      return std::exp(slope * seconds(t)) - spec.log_epsilon;
                                    }))
                   .size()) /
           kFieldPixels;
  };
  EXPECT_NEAR(count(3), 25, 0.6);
  EXPECT_NEAR(count(-6), 20, 1.1);
  EXPECT_NEAR(count(-2), 0, 0.01);
}

}  // namespace
}  // namespace dodgesim
