// Hot pixels: how many there are, how often they fire, and when they are silent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "sim/events/noise.h"
#include "tests/sim/events/dark_events.h"

namespace dodgesim {
namespace {

using testing::dark_events;
using testing::every;
using testing::kFieldHeight;
using testing::kFieldPixels;
using testing::kFieldWidth;

EventCameraSpec only_hot_pixels(double fraction, double rate_hz) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.hot_pixel_fraction = fraction;
  spec.hot_pixel_hz = rate_hz;
  spec.hot_pixel_sigma = 0;
  return spec;
}

TEST(HotPixels, HaveTheSetShareAndRateAndStayWhereTheyAre) {
  const EventCameraSpec spec = only_hot_pixels(0.02, 157);
  const auto count = [&](std::uint64_t throw_index) {
    std::map<std::pair<int, int>, double> events;
    for (const Event& event : dark_events(spec, every(1000000, 10000000), 1, throw_index)) {
      ++events[{event.x, event.y}];
    }
    return events;
  };
  const auto hot = count(0);
  const double expected = spec.hot_pixel_fraction * kFieldPixels;
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

// A DVXplorer's: a mean of 157 Hz, a tenth below 23 Hz, a tenth above 340.
TEST(HotPixels, HaveRatesThatAreSpreadLikeMeasuredOnes) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.hot_pixel_fraction = 1;
  const double seconds = 10;
  std::vector<double> rates_hz(static_cast<std::size_t>(kFieldPixels));
  for (const Event& event : dark_events(spec, every(1000000, 10000000))) {
    rates_hz[std::size_t{event.y} * kFieldWidth + event.x] += 1 / seconds;
  }
  std::ranges::sort(rates_hz);
  const auto quantile = [&](double share) {
    return rates_hz[static_cast<std::size_t>(share * kFieldPixels)];
  };
  EXPECT_NEAR(quantile(0.1), 23, 3);
  EXPECT_NEAR(quantile(0.5), 90, 8);
  EXPECT_NEAR(quantile(0.9), 340, 35);
  const double mean_hz = std::accumulate(rates_hz.begin(), rates_hz.end(), 0.0) / kFieldPixels;
  EXPECT_NEAR(mean_hz, 157, 3 * 157 * std::sqrt(std::expm1(1.05 * 1.05) / kFieldPixels));
}

TEST(HotPixels, ShareTheirEventsBetweenThePolaritiesAsTheShotNoiseDoes) {
  struct Case {
    double on_hz, off_hz, on_share;
  };
  for (const Case& c : {Case{0.3, 0.1, 0.75}, Case{0.1, 0.3, 0.25}, Case{0, 0, 0.5}}) {
    EventCameraSpec spec = only_hot_pixels(0.02, 100);
    spec.shot_noise_on_hz = c.on_hz;
    spec.shot_noise_off_hz = c.off_hz;
    const auto pixels = static_cast<std::size_t>(kFieldPixels);
    Noise noise(spec, kFieldWidth, std::vector<Thresholds>(pixels, {0.2, 0.2}), 1, 0, "top");
    noise.reset(0);
    const std::vector<float> luminance(pixels, 0.2F);
    double on = 0, all = 0;
    for (const NoiseEvent& event :
         noise.take(10000000, {0, 0, kFieldWidth, kFieldHeight}, luminance.data())) {
      if (event.cause != kCauseHotPixel) continue;
      on += event.on;
      ++all;
    }
    ASSERT_GT(all, 30000);
    EXPECT_NEAR(on / all, c.on_share, 4 * std::sqrt(c.on_share * (1 - c.on_share) / all));
  }
}

TEST(HotPixels, AreSilentWithinTheRefractoryPeriod) {
  EventCameraSpec spec = only_hot_pixels(1, 1000);
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
  const double expected = kFieldPixels * (350 * 0.5 + 0.125);
  EXPECT_NEAR(static_cast<double>(events.size()), expected,
              3 * std::sqrt(kFieldPixels * 350 * 0.125));
}

}  // namespace
}  // namespace dodgesim
