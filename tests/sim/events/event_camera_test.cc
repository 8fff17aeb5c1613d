#include "sim/events/event_camera.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "tests/sim/events/reference.h"

namespace dodgesim {
namespace {

using testing::emulate;
using testing::every;
using testing::expect_same;
using testing::film;
using testing::Frames;
using testing::reference_events;

constexpr int kOddWidth = 13;  // no multiple of a vector's length, and not square
constexpr int kOddHeight = 9;

double ramp(int x, int y, TimeUs t) {
  const double slope = 0.3 * (x - 6) + 0.05 * y;  // both directions
  return std::exp(slope * seconds(t) * 100);
}
double sine(int x, int y, TimeUs t) {
  return 1.2 + std::sin(2 * std::numbers::pi * (40 * seconds(t) + 0.05 * x + 0.11 * y));
}
double step(int x, int y, TimeUs t) {
  const bool late = t > 400 * (x + y);
  return late == ((x + y) % 2 == 0) ? 0.05 + 0.1 * x : 3.0 + y;
}
double random_walk(int x, int y, TimeUs t) {
  // A new value at every instant, independent from call to call: the worst case for bookkeeping.
  const RandomStream stream(7, 0, "walk");
  const auto block = stream.block(static_cast<std::uint64_t>(t) * 1000 +
                                  static_cast<std::uint64_t>(y * kOddWidth + x));
  return std::exp(4 * unit_interval(block[0]) - 4);
}

struct Signal {
  const char* name;
  double (*luminance)(int, int, TimeUs);
};

class Exactness : public ::testing::TestWithParam<Signal> {};

INSTANTIATE_TEST_SUITE_P(Signals, Exactness,
                         ::testing::Values(Signal{"ramp", ramp}, Signal{"sine", sine},
                                           Signal{"step", step}, Signal{"random", random_walk}),
                         [](const auto& info) { return info.param.name; });

void expect_reference(const EventCameraSpec& spec, const Frames& frames) {
  EventCamera camera(spec, kOddWidth, kOddHeight, 3, 0, "top");
  const auto events = emulate(camera, frames);
  const auto expected =
      reference_events(camera, frames, spec.log_epsilon, static_cast<double>(spec.refractory_us));
  ASSERT_GT(expected.size(), 100u);
  expect_same(events, expected);
}

TEST_P(Exactness, EventsAreTheCrossingsOfLogLuminance) {
  expect_reference(event_camera_preset("ideal"),
                   film(kOddWidth, kOddHeight, every(700, 70000), GetParam().luminance));
}

TEST_P(Exactness, HoldsWithMismatchAndUnequalThresholds) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.mismatch_sigma = 0.03;
  spec.contrast_threshold_on = 0.15;
  spec.contrast_threshold_off = 0.25;
  expect_reference(spec, film(kOddWidth, kOddHeight, every(700, 70000), GetParam().luminance));
}

TEST_P(Exactness, HoldsWithRefractoryPeriodsShorterAndLongerThanTheInterval) {
  EventCameraSpec spec = event_camera_preset("ideal");
  for (const int refractory_us : {1, 150, 700, 1900}) {
    spec.refractory_us = refractory_us;
    expect_reference(spec, film(kOddWidth, kOddHeight, every(700, 70000), GetParam().luminance));
  }
}

// One pixel whose L follows the given points.
std::vector<Event> single_pixel(const EventCameraSpec& spec,
                                const std::vector<std::pair<TimeUs, double>>& points) {
  Frames frames;
  for (const auto& [t, l] : points) {
    frames.push_back({t, {static_cast<float>(std::exp(l) - spec.log_epsilon)}});
  }
  EventCamera camera(spec, 1, 1, 1, 0, "top");
  return emulate(camera, frames);
}

std::vector<TimeUs> stamps(const std::vector<Event>& events) {
  std::vector<TimeUs> out;
  for (const Event& event : events) out.push_back(event.t_us * event.polarity);
  return out;
}

TEST(EventCamera, StampsLieWhereTheThresholdsAreCrossed) {
  EXPECT_EQ(stamps(single_pixel(event_camera_preset("ideal"), {{0, 0}, {1000, 1.1}, {2000, 0.15}})),
            // Up through .2 .4 .6 .8 1.0; then down through .8 .6 .4 .2 at 1000 (1.1 - L)/.95.
            (std::vector<TimeUs>{182, 364, 545, 727, 909, -1316, -1526, -1737, -1947}));
}

TEST(EventCamera, PixelIsHeldAndRearmedAtTheLuminanceOfThatInstant) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.refractory_us = 300;
  // L = t/1 ms. Event at 200, re-armed at 500 with reference .5, event at 700, re-armed at 1000
  // exactly with the sample there; the way down starts from that reference.
  EXPECT_EQ(stamps(single_pixel(spec, {{0, 0}, {1000, 1}, {2000, 0}})),
            (std::vector<TimeUs>{200, 700, -1200, -1700}));
}

TEST(EventCamera, ChangesWithinTheRefractoryPeriodAreLost) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.refractory_us = 1000;
  // After the event at 1000 (1/5) the pixel sees nothing until 1200.
  EXPECT_EQ(stamps(single_pixel(spec, {{0, 0}, {1000, 1}, {1100, 0}, {1200, 1}, {1300, 1.1}})),
            (std::vector<TimeUs>{200}));
}

TEST(EventCamera, BrighterIsOnDarkerIsOffAtTheRightPlace) {
  const int x = 11;
  const int y = 2;
  for (const double end : {3.0, 0.3}) {
    const auto frames = film(kOddWidth, kOddHeight, {0, 1000}, [&](int px, int py, TimeUs t) {
      return px == x && py == y && t > 0 ? end : 1.0;
    });
    EventCamera camera(event_camera_preset("ideal"), kOddWidth, kOddHeight, 1, 0, "top");
    const auto events = emulate(camera, frames);
    ASSERT_FALSE(events.empty());
    for (const Event& event : events) {
      EXPECT_EQ(event.x, x);
      EXPECT_EQ(event.y, y);
      EXPECT_EQ(event.polarity, end > 1 ? 1 : -1);
    }
  }
}

TEST(EventCamera, NoPixelIsEverStuck) {
  EventCameraSpec spec;  // with everything on, and strong
  spec.shot_noise_on_hz = 20;
  spec.hot_pixel_fraction = 0.05;
  spec.hot_pixel_hz = 2000;
  for (const int refractory_us : {0, 100, 3000}) {
    spec.refractory_us = refractory_us;
    EventCamera camera(spec, kOddWidth, kOddHeight, 5, 0, "top");
    const auto frames = film(kOddWidth, kOddHeight, every(900, 90000), random_walk);
    std::vector<Event> events;
    int armed = 0;
    camera.reset(0, frames[0].luminance.data());
    for (std::size_t i = 1; i < frames.size(); ++i) {
      camera.update(frames[i].t_us, frames[i].luminance.data(), events);
      armed += testing::expect_within_thresholds(camera);
    }
    EXPECT_GT(armed, 1000);
    // Held pixels come back.
    testing::expect_events_of_all_after(84000, camera, events);
  }
}

TEST(EventCamera, SumOfSignedThresholdsIsTheChangeOfTheReference) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.mismatch_sigma = 0.03;
  EventCamera camera(spec, kOddWidth, kOddHeight, 5, 0, "top");
  const auto frames = film(kOddWidth, kOddHeight, every(900, 90000), random_walk);
  const auto events = emulate(camera, frames);
  std::map<std::pair<int, int>, double> sum;
  for (const Event& event : events) {
    const PixelState p = camera.pixel(event.x, event.y);
    sum[{event.x, event.y}] += event.polarity > 0 ? p.threshold_on : -p.threshold_off;
  }
  for (int y = 0; y < kOddHeight; ++y) {
    for (int x = 0; x < kOddWidth; ++x) {
      const auto first = frames[0].luminance[static_cast<std::size_t>(y * kOddWidth + x)];
      const double start = std::log(spec.log_epsilon + static_cast<double>(first));
      const double change = camera.pixel(x, y).reference - start;
      EXPECT_NEAR((sum[{x, y}]), change, 1e-9);
    }
  }
}

TEST(EventCamera, EventsAreOrderedWithinAndAcrossUpdates) {
  for (const TimeUs step_us : {300, 3000, 6000000}) {
    EventCameraSpec spec;
    spec.refractory_us = 0;
    spec.shot_noise_on_hz = 50;
    EventCamera camera(spec, kOddWidth, kOddHeight, 5, 0, "top");
    std::vector<Event> events;
    TimeUs previous = 0;
    const auto frames = film(kOddWidth, kOddHeight, every(step_us, 30 * step_us), random_walk);
    camera.reset(0, frames[0].luminance.data());
    for (std::size_t i = 1; i < frames.size(); ++i) {
      const std::size_t known = events.size();
      camera.update(frames[i].t_us, frames[i].luminance.data(), events);
      for (std::size_t n = known; n < events.size(); ++n) {
        ASSERT_GT(events[n].t_us, previous);
        ASSERT_LE(events[n].t_us, frames[i].t_us);
      }
      previous = frames[i].t_us;
    }
    ASSERT_GT(events.size(), 5000u);
    EXPECT_TRUE(std::is_sorted(events.begin(), events.end(), testing::event_order));
  }
}

TEST(EventCamera, SamplingALinearRampTwiceAsOftenGivesTheSameEvents) {
  EventCameraSpec spec;
  spec.photoreceptor_hz = 0;
  spec.jitter_us = 0;  // depends on the microsecond
  spec.shot_noise_on_hz = 5;
  spec.hot_pixel_fraction = 0.02;
  const auto run = [&](TimeUs step_us) {
    EventCamera camera(spec, kOddWidth, kOddHeight, 5, 0, "top");
    return emulate(camera,
                   film(kOddWidth, kOddHeight, every(step_us, 64000), [&](int x, int y, TimeUs t) {
                     return std::exp((0.8 * x - 0.5 * y) * seconds(t) * 2) - spec.log_epsilon;
                   }));
  };
  const auto coarse = run(1000);
  for (const TimeUs step_us : {500, 250}) {
    auto fine = run(step_us);
    ASSERT_EQ(fine.size(), coarse.size());
    const auto by_pixel = [](const Event& a, const Event& b) {
      return std::tie(a.y, a.x, a.t_us) < std::tie(b.y, b.x, b.t_us);
    };
    auto sorted = coarse;
    std::sort(sorted.begin(), sorted.end(), by_pixel);
    std::sort(fine.begin(), fine.end(), by_pixel);
    for (std::size_t i = 0; i < fine.size(); ++i) {
      EXPECT_EQ(fine[i].x, sorted[i].x);
      EXPECT_EQ(fine[i].y, sorted[i].y);
      EXPECT_EQ(fine[i].polarity, sorted[i].polarity);
      EXPECT_LE(std::abs(fine[i].t_us - sorted[i].t_us), 1);
    }
  }
}

TEST(EventCamera, StampsDoNotClumpAtTheSamples) {
  // Two periods without a common multiple: L never comes back to where all references started.
  const auto frames = film(64, 48, every(1000, 200000), [](int x, int y, TimeUs t) {
    return 1.6 + std::sin(0.3 * x + 0.17 * y + 91 * seconds(t)) * std::cos(0.23 * y - 0.05 * x) +
           0.5 * std::sin(0.1 * x - 0.2 * y + 57 * seconds(t));
  });
  EventCamera camera(event_camera_preset("ideal"), 64, 48, 5, 0, "top");
  const auto events = emulate(camera, frames);
  ASSERT_GT(events.size(), 50000u);
  std::array<int, 10> histogram{};
  for (const Event& event : events) ++histogram[static_cast<std::size_t>(event.t_us % 1000 / 100)];
  const double even = static_cast<double>(events.size()) / 10;
  for (const int count : histogram) EXPECT_NEAR(count, even, 4 * std::sqrt(even));
}

TEST(EventCamera, MismatchHasTheSetSpreadAndBelongsToTheDevice) {
  EventCameraSpec spec;
  spec.dead_pixel_fraction = 0;
  constexpr int kSide = 200;
  EventCamera camera(spec, kSide, kSide, 5, 0, "top");
  EventCamera later_throw(spec, kSide, kSide, 5, 17, "top");
  EventCamera other_camera(spec, kSide, kSide, 5, 0, "bottom");
  EventCamera other_seed(spec, kSide, kSide, 6, 0, "top");
  const double n = kSide * kSide;
  double on = 0, off = 0, on2 = 0, off2 = 0, cross = 0, within = 0, camera_cross = 0,
         seed_cross = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const PixelState p = camera.pixel(x, y);
      const double a = (p.threshold_on - spec.contrast_threshold_on) / spec.mismatch_sigma;
      const double b = (p.threshold_off - spec.contrast_threshold_off) / spec.mismatch_sigma;
      on += a / n;
      off += b / n;
      on2 += a * a / n;
      off2 += b * b / n;
      cross += a * b / n;
      within += std::abs(a) < 1 ? 1 / n : 0;
      const auto normal = [&](const EventCamera& c) {
        return (c.pixel(x, y).threshold_on - spec.contrast_threshold_on) / spec.mismatch_sigma;
      };
      camera_cross += a * normal(other_camera) / n;
      seed_cross += a * normal(other_seed) / n;
      ASSERT_EQ(later_throw.pixel(x, y).threshold_on, p.threshold_on);
      ASSERT_EQ(later_throw.pixel(x, y).threshold_off, p.threshold_off);
    }
  }
  const double sigma = 1 / std::sqrt(n);
  for (const double mean : {on, off, cross, camera_cross, seed_cross})
    EXPECT_NEAR(mean, 0, 4 * sigma);
  EXPECT_NEAR(on2, 1, 4 * std::sqrt(2.0) * sigma);
  EXPECT_NEAR(off2, 1, 4 * std::sqrt(2.0) * sigma);
  EXPECT_NEAR(within, 0.6827, 4 * 0.466 * sigma);
}

TEST(EventCamera, ThresholdsNeverFallBelowTheirMinimum) {
  EventCameraSpec spec;
  spec.mismatch_sigma = 0.5;
  EventCamera camera(spec, 50, 50, 5, 0, "top");
  double least = 1;
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 50; ++x) {
      least = std::min({least, camera.pixel(x, y).threshold_on, camera.pixel(x, y).threshold_off});
    }
  }
  EXPECT_EQ(least, spec.threshold_min);
}

TEST(EventCamera, RebaseMakesNoEventsAndKeepsThePhaseOfEveryPixel) {
  EventCamera camera(event_camera_preset("ideal"), kOddWidth, kOddHeight, 5, 0, "top");
  const auto frames = film(kOddWidth, kOddHeight, {0, 1000, 2000}, random_walk);
  std::vector<Event> events;
  camera.reset(0, frames[0].luminance.data());
  camera.update(1000, frames[1].luminance.data(), events);
  std::vector<double> phase;
  for (int i = 0; i < kOddWidth * kOddHeight; ++i) {
    const PixelState p = camera.pixel(i % kOddWidth, i / kOddWidth);
    phase.push_back(p.signal - p.reference);
  }
  events.clear();
  camera.rebase(frames[2].luminance.data());
  camera.update(2000, frames[2].luminance.data(), events);
  EXPECT_TRUE(events.empty());
  for (int i = 0; i < kOddWidth * kOddHeight; ++i) {
    const PixelState p = camera.pixel(i % kOddWidth, i / kOddWidth);
    EXPECT_NEAR(p.signal - p.reference, phase[static_cast<std::size_t>(i)], 1e-12);
  }
}

TEST(EventCamera, ResetStartsTheSameThrowAgain) {
  EventCameraSpec spec;
  spec.shot_noise_on_hz = 30;
  EventCamera camera(spec, kOddWidth, kOddHeight, 5, 2, "top");
  const auto frames = film(kOddWidth, kOddHeight, every(900, 90000), sine);
  const auto first = emulate(camera, frames);
  EXPECT_EQ(emulate(camera, frames), first);
  EventCamera again(spec, kOddWidth, kOddHeight, 5, 2, "top");
  EXPECT_EQ(emulate(again, frames), first);
}

TEST(EventCamera, RefusesLuminanceThatHasNoLogarithmAndTimeThatStands) {
  EventCamera camera(EventCameraSpec(), 2, 1, 1, 0, "top");
  const std::array<float, 2> good = {1, 1};
  std::vector<Event> events;
  camera.reset(0, good.data());
  EXPECT_THROW(camera.update(0, good.data(), events), std::invalid_argument);
  for (const float bad :
       {-1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const std::array<float, 2> picture = {1, bad};
    camera.reset(0, good.data());
    EXPECT_THROW(camera.update(1000, picture.data(), events), SimulationError);
    EXPECT_THROW(camera.reset(0, picture.data()), SimulationError);
  }
  EXPECT_THROW(EventCamera(EventCameraSpec(), 0, 5, 1, 0, "top"), std::invalid_argument);
  EXPECT_THROW(EventCamera(EventCameraSpec(), 70000, 5, 1, 0, "top"), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim
