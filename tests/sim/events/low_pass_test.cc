// Events of pixels with a photoreceptor's bandwidth: their stamps against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "sim/base/random.h"
#include "sim/events/photoreceptor.h"
#include "tests/sim/events/reference.h"

namespace dodgesim {
namespace {

using testing::emulate;
using testing::every;
using testing::film;
using testing::Frames;

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr TimeUs kStepUs = 1000;

// One pixel that sees luminance `a`, and after kStepUs + 1 us `b`, sampled at the given period.
std::vector<Event> step_response(const EventCameraSpec& spec, double a, double b,
                                 TimeUs period_us) {
  std::vector<TimeUs> times = {0, kStepUs, kStepUs + 1};
  while (times.back() < 100000) times.push_back(times.back() + period_us);
  EventCamera camera(spec, 1, 1, 1, 0, "top");
  return emulate(camera,
                 film(1, 1, times, [&](int, int, TimeUs t) { return t > kStepUs ? b : a; }));
}

// When a rising share of a step, share(t) from 0 to 1, passes `level`, by bisection [us].
double instant(const std::function<double(double)>& share, double level) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (share(middle) < level ? low : high) = middle;
  }
  return 1e6 * low;
}

class StepResponse : public ::testing::TestWithParam<TimeUs> {};
INSTANTIATE_TEST_SUITE_P(Periods, StepResponse, ::testing::Values(50, 1000, 30000));

TEST_P(StepResponse, EventsLieOnTheExponential) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 3000;
  for (const auto& [a, b] : {std::pair{0.1, 0.9}, {0.9, 0.1}, {0.02, 0.05}}) {
    const double w = kTwoPi * (100 + 1500 * b);  // at half of 1000 lux
    const double swing = std::abs(std::log((1e-3 + b) / (1e-3 + a)));
    const auto events = step_response(spec, a, b, GetParam());
    ASSERT_EQ(events.size(), std::floor(swing / 0.2));
    for (std::size_t k = 0; k < events.size(); ++k) {
      const double level = 0.2 * static_cast<double>(k + 1) / swing;
      const double expected_us = kStepUs + 0.5 - 1e6 * std::log(1 - level) / w;
      EXPECT_EQ(events[k].polarity, b > a ? 1 : -1);
      // The state of the low-pass is of single precision; where the curve is flat, that is late.
      const double slope_1us = 1e-6 * w * swing * (1 - level);
      EXPECT_NEAR(static_cast<double>(events[k].t_us), expected_us, 1.5 + 0.0005 / slope_1us);
    }
  }
}

TEST_P(StepResponse, OfSecondOrderStartsFlat) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 3000;
  spec.follower_hz = 400;
  const double w1 = kTwoPi * (100 + 1500 * 0.9), w2 = kTwoPi * 400;
  const double swing = std::log(0.901 / 0.101);
  const auto events = step_response(spec, 0.1, 0.9, GetParam());
  ASSERT_EQ(events.size(), std::floor(swing / 0.2));
  const auto share = [&](double t_s) {
    return 1 - (w1 * std::exp(-w2 * t_s) - w2 * std::exp(-w1 * t_s)) / (w1 - w2);
  };
  for (std::size_t k = 0; k < events.size(); ++k) {
    const double level = 0.2 * static_cast<double>(k + 1) / swing;
    const double expected_us = kStepUs + 0.5 + instant(share, level);
    const double t_s = 1e-6 * (expected_us - kStepUs);
    const double slope_1us = 1e6 * swing * (share(t_s + 1e-12) - share(t_s)) + 1e-12;
    const double per_us = 1e-6 * slope_1us * 1e6;
    EXPECT_NEAR(static_cast<double>(events[k].t_us), expected_us, 1.5 + 0.002 / per_us);
  }
}

// Light that goes up and down from frame to frame makes the output turn between them: the events of
// a pixel whose output is evaluated every microsecond.
std::vector<Event> events_every_microsecond(const std::vector<double>& response, TimeUs frame_us,
                                            double cutoff_rad_s, double threshold) {
  std::vector<Event> events;
  double y0 = response[0], reference = response[0];
  for (std::size_t k = 1; k < response.size(); ++k) {
    const double slope_1s = (response[k] - response[k - 1]) / seconds(frame_us);
    const auto output = [&](double t_s) {
      const double lag = slope_1s / cutoff_rad_s;
      return response[k - 1] + slope_1s * t_s - lag +
             (y0 - response[k - 1] + lag) * std::exp(-cutoff_rad_s * t_s);
    };
    for (TimeUs t = 1; t <= frame_us; ++t) {
      const double y = output(seconds(t));
      while (y >= reference + threshold || y <= reference - threshold) {
        const int sign = y > reference ? 1 : -1;
        reference += sign * threshold;
        events.push_back(
            {static_cast<TimeUs>(k - 1) * frame_us + t, 0, 0, static_cast<std::int8_t>(sign)});
      }
    }
    y0 = output(seconds(frame_us));
  }
  return events;
}

TEST(LowPass, MakesTheEventsOfAnOutputThatTurnsBetweenSamples) {
  constexpr TimeUs kFrameUs = 10000;
  constexpr double kCutoffHz = 35;
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 1e-9;
  spec.photoreceptor_dark_hz = kCutoffHz;
  RandomStream random(4, 0, "films");
  std::size_t count = 0;
  for (int n = 0; n < 60; ++n) {
    std::vector<double> response;
    Frames frames;
    for (TimeUs t = 0; t <= 10 * kFrameUs; t += kFrameUs) {
      const auto light = static_cast<float>(std::exp(random.uniform(-2, 0)));
      response.push_back(std::log(spec.log_epsilon + static_cast<double>(light)));
      frames.push_back({t, {light}});
    }
    EventCamera camera(spec, 1, 1, 1, 0, "top");
    const auto events = emulate(camera, frames);
    const auto expected = events_every_microsecond(response, kFrameUs, kTwoPi * kCutoffHz, 0.2);
    ASSERT_EQ(events.size(), expected.size()) << n;
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_EQ(events[i].polarity, expected[i].polarity);
      // Where the output turns it is flat, and single precision shifts the crossing.
      EXPECT_NEAR(static_cast<double>(events[i].t_us), static_cast<double>(expected[i].t_us), 40);
    }
    count += events.size();
  }
  EXPECT_GT(count, 300u);
}

// The output of two low-passes is followed in straight pieces.
TEST(LowPass, OfSecondOrderLosesNoPeakThatIsAPerCentBeyondTheThreshold) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 1e-9;
  spec.photoreceptor_dark_hz = 50;
  spec.follower_hz = 200;
  const Photoreceptor photoreceptor(spec);
  const auto outputs = [&](double amplitude, const std::function<void(double)>& visit) {
    Charge charge;
    for (const double u1 : {amplitude, 0.0}) {
      for (TimeUs t = 10; t <= 10000; t += 10) {
        visit(photoreceptor.at(charge, 1, u1, 0.01, seconds(t)).z);
      }
      charge = photoreceptor.at(charge, 1, u1, 0.01, 0.01);
    }
  };
  double unit_peak = 0;
  outputs(1, [&](double z) { unit_peak = std::max(unit_peak, z); });
  for (const double share : {1.01, 1.05}) {
    const auto bright = static_cast<float>(
        (1 + spec.log_epsilon) * std::exp(share * 0.2 / unit_peak) - spec.log_epsilon);
    EventCamera camera(spec, 1, 1, 1, 0, "top");
    const auto events = emulate(camera, {{0, {1.0F}}, {10000, {bright}}, {20000, {1.0F}}});
    EXPECT_EQ(events.size(), 1u) << share;
  }
}

TEST(LowPass, ATenTimesDarkerSceneAnswersTenTimesSlower) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 3000;
  spec.photoreceptor_dark_hz = 0.01;
  const auto at = [&](double lux) {
    spec.illuminance_lux = lux;
    return static_cast<double>(step_response(spec, 0.1, 0.9, 1000).at(4).t_us - kStepUs);
  };
  EXPECT_NEAR(at(50) / at(500), 10, 0.2);
  EXPECT_NEAR(at(5) / at(50), 10, 0.2);
}

TEST(LowPass, SamplingMoreOftenGivesTheSameEvents) {
  // The light rises steadily by 300/s in log luminance, which the photoreceptor follows with a lag.
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 3000;
  spec.follower_hz = 2000;
  const auto run = [&](TimeUs period_us) {
    EventCamera camera(spec, 1, 1, 1, 0, "top");
    return emulate(camera, film(1, 1, every(period_us, 20000), [&](int, int, TimeUs t) {
                     return 0.01 * std::exp(300 * seconds(t)) - spec.log_epsilon;
                   }));
  };
  const auto coarse = run(1000), fine = run(50);
  ASSERT_EQ(coarse.size(), fine.size());
  ASSERT_GT(coarse.size(), 25u);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(coarse[i].t_us), static_cast<double>(fine[i].t_us), 12);
  }
}

TEST(LowPass, TheFollowerAloneIsALowPassOfFirstOrder) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.follower_hz = 10;
  const double w = kTwoPi * 10, swing = std::log(0.201 / 0.101);
  for (const double light : {1.0, 0.01}) {  // whatever the light
    spec.illuminance_lux = 500 * light;
    const auto events = step_response(spec, 0.1, 0.2, 50);
    ASSERT_EQ(events.size(), 3u);
    for (std::size_t k = 0; k < events.size(); ++k) {
      const double expected_us =
          kStepUs + 0.5 - 1e6 * std::log(1 - 0.2 * static_cast<double>(k + 1) / swing) / w;
      EXPECT_NEAR(static_cast<double>(events[k].t_us), expected_us, 0.001 * expected_us);
    }
  }
}

TEST(LowPass, FastFlickerMakesNoEvents) {
  // 5 kHz by a factor of 2 under a cut-off of 250 Hz: a twentieth of the swing of 0.7 is left.
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 500;
  spec.photoreceptor_dark_hz = 0.01;
  const auto flicker = [](int, int, TimeUs t) { return t / 100 % 2 == 0 ? 1.0 : 0.5; };
  const Frames frames = film(1, 1, every(20, 50000), flicker);
  EventCamera slow(spec, 1, 1, 1, 0, "top");
  const auto settled = emulate(slow, frames);
  EXPECT_LT(settled.size(), 4u);  // while it settles
  EventCamera fast(event_camera_preset("ideal"), 1, 1, 1, 0, "top");
  EXPECT_GT(emulate(fast, frames).size(), 1000u);
}

TEST(LowPass, NoPixelIsEverStuckAndOrderHolds) {
  for (const double follower_hz : {0.0, 800.0}) {
    EventCameraSpec spec;  // sees1
    spec.follower_hz = follower_hz;
    spec.leak_hz = 20;
    constexpr int kWidth = 37, kHeight = 11;
    EventCamera camera(spec, kWidth, kHeight, 3, 0, "top");
    const auto luminance = [](int x, int y, TimeUs t) {
      const auto block = RandomStream(7, 0, "walk")
                             .block(static_cast<std::uint64_t>(t) * 1000 +
                                    static_cast<std::uint64_t>(y * kWidth + x));
      return std::exp(4 * unit_interval(block[0]) - 4);
    };
    std::vector<Event> events;
    for (const auto& frame : film(kWidth, kHeight, every(700, 70000), luminance)) {
      if (frame.t_us == 0) {
        camera.reset(0, frame.luminance.data());
        continue;
      }
      camera.update(frame.t_us, frame.luminance.data(), events);
      for (int i = 0; i < kWidth * kHeight; ++i) {
        const PixelState p = camera.pixel(i % kWidth, i / kWidth);
        if (p.held) continue;
        ASSERT_LT(p.signal - p.reference, p.threshold_on);
        ASSERT_GT(p.signal - p.reference, -p.threshold_off);
      }
    }
    EXPECT_GT(events.size(), 10000u);
    EXPECT_TRUE(std::is_sorted(events.begin(), events.end(), testing::event_order));
  }
}

TEST(LowPass, RebaseMakesNoEventsAndKeepsWhatIsStillSettling) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 3000;
  spec.follower_hz = 1000;
  const auto run = [&](bool rebase) {
    EventCamera camera(spec, 1, 1, 1, 0, "top");
    std::vector<Event> events;
    const float dark = 0.1f, bright = 0.9f;
    camera.reset(0, &dark);
    camera.update(100, &bright, events);  // not yet settled
    if (rebase) camera.rebase(&bright);
    camera.update(10000, &bright, events);
    return events;
  };
  ASSERT_GT(run(false).size(), 8u);
  EXPECT_EQ(run(true), run(false));
  EventCamera camera(spec, 1, 1, 1, 0, "top");
  std::vector<Event> events;
  const float dark = 0.1f, bright = 0.9f;
  camera.reset(0, &dark);
  camera.update(100, &dark, events);
  camera.rebase(&bright);
  camera.update(10000, &bright, events);
  EXPECT_TRUE(events.empty());
}

// A pixel whose cut-off follows the light: with the light of either end of an interval instead of
// the mean its stamps would be 0.1 ms off.
TEST(LowPass, StampsOfFramesAMillisecondApartAreThoseOfFinerOnes) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 200;
  spec.photoreceptor_dark_hz = 5;
  constexpr int kPixels = 16;
  const auto flickering = [](int x, int /*y*/, TimeUs t_us) {
    return 0.4 * std::exp(std::sin(kTwoPi * (20e-6 * static_cast<double>(t_us) +
                                             x / static_cast<double>(kPixels))));
  };
  // A list for each pixel.
  const auto events = [&](TimeUs period_us) {
    EventCamera camera(spec, kPixels, 1, 1, 0, "top");
    std::vector<std::vector<Event>> lists(kPixels);
    for (const Event& event :
         emulate(camera, film(kPixels, 1, every(period_us, 200000), flickering))) {
      lists[event.x].push_back(event);
    }
    return lists;
  };
  const auto coarse = events(1000), fine = events(10);
  int same_counts = 0;
  for (std::size_t x = 0; x < kPixels; ++x) {
    ASSERT_NEAR(static_cast<double>(coarse[x].size()), static_cast<double>(fine[x].size()), 2);
    if (coarse[x].size() != fine[x].size()) continue;
    ++same_counts;
    double sum_us = 0;
    for (std::size_t i = 0; i < fine[x].size(); ++i) {
      EXPECT_EQ(coarse[x][i].polarity, fine[x][i].polarity);
      sum_us += std::abs(static_cast<double>(coarse[x][i].t_us - fine[x][i].t_us));
    }
    EXPECT_LT(sum_us / static_cast<double>(fine[x].size()), 40) << x;
  }
  EXPECT_GE(same_counts, 12);
}

}  // namespace
}  // namespace dodgesim
