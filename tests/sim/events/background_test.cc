#include "sim/events/background.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/sim/events/reference.h"

namespace dodgesim {
namespace {

using testing::emulate;
using testing::every;
using testing::film;

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr double kPixels = kWidth * kHeight;

std::vector<Event> dark_events(const EventCameraSpec& spec, const std::vector<TimeUs>& times,
                               std::uint64_t seed = 1, std::uint64_t throw_index = 0,
                               std::string_view name = "top") {
  EventCamera camera(spec, kWidth, kHeight, seed, throw_index, name);
  return emulate(camera, film(kWidth, kHeight, times, [](int, int, TimeUs) { return 0.2; }));
}

EventCameraSpec only_background() {
  EventCameraSpec spec;
  spec.hot_pixel_fraction = 0;
  return spec;
}

TEST(BackgroundActivity, HasTheSetRatesOfBothPolarities) {
  const EventCameraSpec spec = only_background();
  const double duration_s = 60;
  const auto events = dark_events(spec, every(5000000, 60000000));
  double on = 0;
  for (const Event& event : events) on += event.polarity > 0 ? 1 : 0;
  const double off = static_cast<double>(events.size()) - on;
  const double expected_on = spec.background_on_hz * kPixels * duration_s;
  const double expected_off = spec.background_off_hz * kPixels * duration_s;
  EXPECT_NEAR(on, expected_on, 3 * std::sqrt(expected_on));
  EXPECT_NEAR(off, expected_off, 3 * std::sqrt(expected_off));
}

TEST(BackgroundActivity, DoesNotDependOnTheInstantsOfSampling) {
  const EventCameraSpec spec;
  const auto coarse = dark_events(spec, every(100000, 1000000));
  const auto fine = dark_events(spec, every(100, 1000000));
  const auto uneven = dark_events(spec, {0, 1, 17, 3000, 3001, 250000, 999999, 1000000});
  ASSERT_GT(coarse.size(), 1000u);
  EXPECT_EQ(coarse, fine);
  EXPECT_EQ(coarse, uneven);
}

TEST(BackgroundActivity, IsPoissonInTimeAndUniformOverThePixels) {
  BackgroundActivity activity(RandomStream(3, 0, "test"), 100, 2.0, 0.5);
  std::vector<BackgroundEvent> events;
  activity.take_until(100000000, events);
  const auto n = static_cast<double>(events.size());
  EXPECT_NEAR(n, 20000, 3 * std::sqrt(20000.0));
  double mean = 0, square = 0, long_waits = 0;
  std::map<std::uint32_t, int> per_pixel;
  TimeUs previous = 0;
  for (const BackgroundEvent& event : events) {
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

TEST(BackgroundActivity, DiffersBetweenCamerasThrowsAndSeedsAndIsTheSameOtherwise) {
  const EventCameraSpec spec = only_background();
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

TEST(BackgroundActivity, HotPixelsHaveTheSetShareAndRateAndStayWhereTheyAre) {
  EventCameraSpec spec;
  spec.background_on_hz = 0;
  spec.background_off_hz = 0;
  spec.refractory_us = 0;
  spec.hot_pixel_fraction = 0.02;
  const auto count = [&](std::uint64_t throw_index) {
    std::map<std::pair<int, int>, double> events;
    for (const Event& event : dark_events(spec, every(1000000, 10000000), 1, throw_index)) {
      ++events[{event.x, event.y}];
    }
    return events;
  };
  const auto hot = count(0);
  const double expected = spec.hot_pixel_fraction * kPixels;
  EXPECT_NEAR(static_cast<double>(hot.size()), expected, 3 * std::sqrt(expected));
  double total = 0;
  for (const auto& [pixel, events] : hot) {
    EXPECT_NEAR(events, 1570, 4.5 * std::sqrt(1570.0));
    total += events;
  }
  const double expected_total = static_cast<double>(hot.size()) * 1570;
  EXPECT_NEAR(total, expected_total, 3 * std::sqrt(expected_total));
  const auto later = count(9);
  ASSERT_EQ(later.size(), hot.size());
  EXPECT_TRUE(std::equal(later.begin(), later.end(), hot.begin(),
                         [](const auto& a, const auto& b) { return a.first == b.first; }));
}

TEST(BackgroundActivity, IsLostWithinTheRefractoryPeriod) {
  EventCameraSpec spec;
  spec.background_on_hz = 0;
  spec.background_off_hz = 0;
  spec.hot_pixel_fraction = 1;
  spec.hot_pixel_hz = 1000;
  spec.refractory_us = 1000;
  const auto events = dark_events(spec, every(7000, 350000));
  std::map<std::pair<int, int>, TimeUs> last;
  for (const Event& event : events) {
    const auto [place, first] = last.try_emplace({event.x, event.y}, event.t_us);
    if (!first) {
      EXPECT_GE(event.t_us - place->second, 1000);
      place->second = event.t_us;
    }
  }
  // A process with dead time d has the rate r/(1 + r d): here half; starting without dead time adds
  // (r d)^2/(2 (1 + r d)^2) events, and counts spread by 1/(1 + r d)^3 of their mean rate.
  const double expected = kPixels * (350 * 0.5 + 0.125);
  EXPECT_NEAR(static_cast<double>(events.size()), expected, 3 * std::sqrt(kPixels * 350 * 0.125));
}

TEST(BackgroundActivity, ResetsThePixelItHits) {
  // L falls by 0.3 in all. A pixel hit by chance in the last 60 ms has less than a threshold to go
  // from there, so at the end its reference still is the L at that instant.
  EventCameraSpec spec = ideal_event_camera();
  spec.background_on_hz = 50;
  for (const int refractory_us : {0, 100}) {
    spec.refractory_us = refractory_us;
    EventCamera camera(spec, kWidth, kHeight, 1, 0, "top");
    const auto l = [](TimeUs t) { return std::exp(-0.3 * seconds(t) / 0.1); };
    const auto events = emulate(camera, film(kWidth, kHeight, every(1000, 100000),
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

}  // namespace
}  // namespace dodgesim
