// Samples of a region between two pictures.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "tests/sim/events/reference.h"

namespace dodgesim {
namespace {

using testing::emulate;
using testing::every;
using testing::expect_same;
using testing::film;
using testing::Frame;
using testing::Frames;
using testing::reference_events;

constexpr int kFrameWidth = 21;
constexpr int kFrameHeight = 11;
constexpr Rect kWhole{0, 0, kFrameWidth, kFrameHeight};

double fast_walk(int x, int y, TimeUs t) {
  const RandomStream stream(8, 0, "walk");
  const auto block = stream.block(static_cast<std::uint64_t>(t) * 1000 +
                                  static_cast<std::uint64_t>(y * kFrameWidth + x));
  return std::exp(3 * unit_interval(block[0]) - 3);
}

double fast_sine(int x, int y, TimeUs t) {
  return 1.2 + std::sin(800 * seconds(t) + 0.3 * x + 0.7 * y);
}

int one_of(RandomStream& random, int count) {
  return static_cast<int>(random.uniform(0, count - 1e-9));
}

// Random, partly overlapping regions, up to eight between two pictures.
Frames film_with_regions(const std::function<double(int, int, TimeUs)>& luminance) {
  RandomStream random(9, 0, "regions");
  Frames frames = film(kFrameWidth, kFrameHeight, every(130, 52000), luminance);
  for (std::size_t i = 1; i + 1 < frames.size(); ++i) {
    if (i % 16 < 8 ? i % 8 == 0 : random.uniform(0, 1) < 0.3) continue;
    Rect rect;
    rect.x0 = one_of(random, kFrameWidth);
    rect.x1 = rect.x0 + 1 + one_of(random, kFrameWidth - rect.x0);
    rect.y0 = one_of(random, kFrameHeight);
    rect.y1 = rect.y0 + 1 + one_of(random, kFrameHeight - rect.y0);
    frames[i].region = rect;
  }
  return frames;
}

EventCameraSpec everything() {
  EventCameraSpec spec;
  spec.shot_noise_on_hz = 20;
  spec.hot_pixel_fraction = 0.05;
  spec.hot_pixel_hz = 2000;
  return spec;
}

TEST(Region, EventsAreTheCrossingsOfEachPixelsOwnCurve) {
  for (const auto& luminance : {fast_walk, fast_sine}) {
    const Frames frames = film_with_regions(luminance);
    for (const int refractory_us : {0, 1, 100, 130, 900}) {
      EventCameraSpec spec = event_camera_preset("ideal");
      spec.refractory_us = refractory_us;
      spec.mismatch_sigma = 0.03;
      EventCamera camera(spec, kFrameWidth, kFrameHeight, 3, 0, "top");
      const auto events = emulate(camera, frames);
      const auto expected =
          reference_events(camera, frames, spec.log_epsilon, static_cast<double>(refractory_us));
      ASSERT_GT(expected.size(), 5000u);
      expect_same(events, expected);
      EXPECT_TRUE(std::is_sorted(events.begin(), events.end(), testing::event_order));
    }
  }
}

TEST(Region, OfTheWholeImageIsAPictureWhoseEventsComeLater) {
  for (const int refractory_us : {0, 100, 900}) {
    EventCameraSpec spec = everything();
    spec.refractory_us = refractory_us;
    EventCamera camera(spec, kFrameWidth, kFrameHeight, 5, 0, "top");
    Frames frames = film(kFrameWidth, kFrameHeight, every(130, 52000), fast_walk);
    const auto pictures = emulate(camera, frames);
    for (std::size_t i = 1; i + 1 < frames.size(); ++i) {
      if (i % 7 != 0) frames[i].region = kWhole;
    }
    ASSERT_GT(pictures.size(), 10000u);
    EXPECT_EQ(emulate(camera, frames), pictures);
  }
}

TEST(Region, ThatShowsNothingNewChangesNothing) {
  EventCameraSpec spec = everything();
  spec.photoreceptor_hz = 0;         // takes its cut-off from the samples
  spec.shot_noise_bright_share = 1;  // or the rate would come from the samples
  spec.jitter_us = 0;                // depends on the microsecond
  EventCamera camera(spec, kFrameWidth, kFrameHeight, 5, 0, "top");
  Frames frames = film(kFrameWidth, kFrameHeight, {0, 10000, 20000}, fast_sine);
  const auto plain = emulate(camera, frames);
  // On the straight line of L between the pictures.
  const Frames between = film(kFrameWidth, kFrameHeight, {0, 4000}, [&](int x, int y, TimeUs) {
    const auto i = static_cast<std::size_t>(y * kFrameWidth + x);
    const double l0 = std::log(spec.log_epsilon + static_cast<double>(frames[0].luminance[i]));
    const double l1 = std::log(spec.log_epsilon + static_cast<double>(frames[1].luminance[i]));
    return std::exp(0.6 * l0 + 0.4 * l1) - spec.log_epsilon;
  });
  frames.insert(frames.begin() + 1, {4000, between[1].luminance, Rect{3, 2, 15, 9}});
  const auto events = emulate(camera, frames);
  ASSERT_EQ(events.size(), plain.size());
  ASSERT_GT(events.size(), 1000u);
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_LE(std::abs(events[i].t_us - plain[i].t_us), 1);
  }
}

TEST(Region, NoPixelIsEverStuck) {
  for (const int refractory_us : {0, 100, 3000}) {
    EventCameraSpec spec = everything();
    spec.refractory_us = refractory_us;
    EventCamera camera(spec, kFrameWidth, kFrameHeight, 5, 0, "top");
    const Frames frames = film_with_regions(fast_walk);
    std::vector<Event> events;
    int armed = 0;
    camera.reset(0, frames[0].luminance.data());
    for (std::size_t i = 1; i < frames.size(); ++i) {
      const Frame& frame = frames[i];
      if (frame.region) {
        camera.add_region(frame.t_us, *frame.region, frame.luminance.data());
        continue;
      }
      camera.update(frame.t_us, frame.luminance.data(), events);
      armed += testing::expect_within_thresholds(camera);
    }
    EXPECT_GT(armed, 1000);
    testing::expect_events_of_all_after(46000, camera, events);
  }
}

TEST(Region, SumOfSignedThresholdsIsTheChangeOfTheReference) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.mismatch_sigma = 0.03;
  EventCamera camera(spec, kFrameWidth, kFrameHeight, 5, 0, "top");
  const Frames frames = film_with_regions(fast_walk);
  std::vector<double> sum(static_cast<std::size_t>(kFrameWidth * kFrameHeight));
  for (const Event& event : emulate(camera, frames)) {
    const PixelState p = camera.pixel(event.x, event.y);
    sum[static_cast<std::size_t>(event.y * kFrameWidth + event.x)] +=
        event.polarity > 0 ? p.threshold_on : -p.threshold_off;
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double start = std::log(spec.log_epsilon + static_cast<double>(frames[0].luminance[i]));
    const int pixel = static_cast<int>(i);
    EXPECT_NEAR(sum[i], camera.pixel(pixel % kFrameWidth, pixel / kFrameWidth).reference - start,
                1e-9);
  }
}

// A textured disk that crosses a static texture at 1.5 px/ms.
double disk(int x, int y, TimeUs t) {
  const double dx = x - 1500 * seconds(t) + 12;
  const double dy = y - 20;
  const double cover = std::clamp(8.5 - std::hypot(dx, dy), 0.0, 1.0);
  const double turn = 20 * seconds(t);
  const double u = std::cos(turn) * dx - std::sin(turn) * dy;
  return cover * (0.6 + 0.4 * std::sin(u)) +
         (1 - cover) * (0.5 + 0.3 * std::sin(0.9 * x + 0.2 * y) * std::cos(0.7 * y));
}

TEST(Region, AboutAllThatMovesGivesTheEventsOfWholePictures) {
  constexpr int kSide = 40;
  for (const EventCameraSpec& spec : {event_camera_preset("ideal"), EventCameraSpec()}) {
    EventCamera camera(spec, kSide, kSide, 5, 0, "top");
    Frames frames = film(kSide, kSide, every(333, 333 * 120), disk);
    const auto whole = emulate(camera, frames);
    ASSERT_GT(whole.size(), 10000u);
    for (std::size_t i = 1; i + 1 < frames.size(); ++i) {
      if (i % 15 == 0) continue;
      // Where the disk is now, and where it was and will be half a pixel away.
      const double middle = 1500 * seconds(frames[i].t_us) - 12;
      const auto side = [](double at) {
        return static_cast<int>(std::clamp(std::round(at), 0.0, static_cast<double>(kSide)));
      };
      frames[i].region = Rect{side(middle - 11), 9, side(middle + 12), 32};
    }
    EXPECT_EQ(emulate(camera, frames), whole);
  }
}

TEST(Region, RefusesTimeThatStandsPixelsThatDoNotExistAndLuminanceWithoutALogarithm) {
  EventCamera camera(event_camera_preset("ideal"), 3, 2, 1, 0, "top");
  const std::array<float, 6> good = {1, 1, 1, 1, 1, 1};
  const std::array<float, 6> bad = {1, std::numeric_limits<float>::quiet_NaN(), 1, 1, 1, 1};
  std::vector<Event> events;
  camera.reset(0, good.data());
  EXPECT_THROW(camera.add_region(0, {0, 0, 3, 2}, good.data()), std::invalid_argument);
  for (const Rect& outside : {Rect{-1, 0, 2, 2}, Rect{0, 0, 4, 2}, Rect{0, 0, 3, 3}}) {
    EXPECT_THROW(camera.add_region(100, outside, good.data()), std::invalid_argument);
  }
  camera.add_region(100, {0, 0, 3, 2}, good.data());
  EXPECT_THROW(camera.add_region(100, {0, 0, 3, 2}, good.data()), std::invalid_argument);
  EXPECT_THROW(camera.update(100, good.data(), events), std::invalid_argument);
  EXPECT_THROW(camera.rebase(good.data()), std::invalid_argument);
  camera.add_region(150, {}, bad.data());
  camera.update(200, good.data(), events);
  camera.rebase(good.data());
  EXPECT_TRUE(events.empty());
  EXPECT_THROW(camera.add_region(300, {1, 0, 2, 1}, bad.data()), SimulationError);
  camera.reset(0, good.data());
  camera.add_region(100, {0, 1, 3, 2}, bad.data());  // not of the bad pixel
  camera.update(200, good.data(), events);
}

}  // namespace
}  // namespace dodgesim
