// Why events happen: ground truth of the event camera.
#include "sim/events/cause.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <utility>

#include "tests/sim/events/reference.h"

namespace dodgesim {
namespace {

using testing::every;
using testing::film;

constexpr int kWidth = 40;
constexpr int kHeight = 30;
constexpr std::size_t kPixels = kWidth * kHeight;

struct Told {
  Event event;
  Cause cause;
};

// The events with their causes, of a film of luminance(x, y, t) in which a pixel shows
// cause(x, y, t).
template <class Luminance, class Shown>
std::vector<Told> emulate(const EventCameraSpec& spec, const std::vector<TimeUs>& times,
                          Luminance luminance, Shown shown) {
  EventCamera camera(spec, kWidth, kHeight, 1, 0, "top", true);
  std::vector<Told> told;
  std::vector<Cause> causes(kPixels);
  for (const auto& frame : film(kWidth, kHeight, times, luminance)) {
    for (int i = 0; i < static_cast<int>(kPixels); ++i) {
      causes[static_cast<std::size_t>(i)] = shown(i % kWidth, i / kWidth, frame.t_us);
    }
    const Picture picture = {frame.luminance.data(), causes.data()};
    if (frame.t_us == times.front()) {
      camera.reset(frame.t_us, picture);
      continue;
    }
    std::vector<Event> events;
    camera.update(frame.t_us, picture, events);
    EXPECT_EQ(camera.causes().size(), events.size());
    for (std::size_t i = 0; i < events.size(); ++i) told.push_back({events[i], camera.causes()[i]});
  }
  return told;
}

std::map<Cause, double> counts(const std::vector<Told>& told) {
  std::map<Cause, double> counts;
  for (const Told& t : told) ++counts[t.cause];
  return counts;
}

constexpr auto kStill = [](int, int, TimeUs) { return 0.2; };
constexpr auto kScene = [](int, int, TimeUs) { return kCauseScene; };

TEST(Cause, OfEveryEventOfAStillSceneIsTheNoiseThatMadeIt) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.leak_hz = 2;
  EXPECT_EQ(counts(emulate(spec, every(10000, 2000000), kStill, kScene)).size(), 1u);
  EXPECT_GT(counts(emulate(spec, every(10000, 2000000), kStill, kScene))[kCauseLeak], 1000);
  spec.shot_noise_on_hz = spec.shot_noise_off_hz = 1;
  spec.shot_noise_bright_share = 1;
  spec.hot_pixel_fraction = 0.01;
  spec.hot_pixel_hz = 100;
  spec.hot_pixel_sigma = 0;
  spec.latency_us = 300;
  spec.jitter_us = 50;
  spec.readout_max_hz = 1e5;
  const auto told = emulate(spec, every(10000, 3000000), kStill, kScene);
  auto by_cause = counts(told);
  EXPECT_EQ(by_cause.size(), 3u);
  const double shot = 3 * 2 * kPixels;
  EXPECT_NEAR(by_cause[kCauseShotNoise], shot, 3 * std::sqrt(shot));
  std::map<std::pair<int, int>, double> hot;
  for (const Told& t : told) {
    if (t.cause == kCauseHotPixel) ++hot[{t.event.x, t.event.y}];
    if (t.cause == kCauseLeak) {
      EXPECT_EQ(t.event.polarity, 1);
    }
  }
  EXPECT_GT(hot.size(), 3u);
  for (const auto& [pixel, count] : hot) EXPECT_NEAR(count, 300, 4 * std::sqrt(300.0));
}

// A bright bar of 4 columns that crosses a scene which itself brightens in the lower half.
double bar_left(TimeUs t) { return -4 + 2e-3 * static_cast<double>(t); }
bool in_bar(int x, TimeUs t) { return x >= bar_left(t) && x < bar_left(t) + 4; }
double bar_film(int x, int y, TimeUs t) {
  return in_bar(x, t) ? 2.0 : (y < kHeight / 2 ? 0.2 : 0.2 * std::exp(50 * seconds(t)));
}

TEST(Cause, OfWhatAnObjectEntersOrLeavesIsTheObject) {
  const Cause object = kCauseFirstObject + 2;
  const auto told =
      emulate(event_camera_preset("ideal"), every(500, 24000), bar_film,
              [&](int x, int, TimeUs t) { return in_bar(x, t) ? object : kCauseScene; });
  ASSERT_EQ(counts(told).size(), 2u);
  double of_object = 0;
  for (const Told& t : told) {
    // The bar moves a pixel in 500 us: it has been at the pixel at one of the samples around.
    const TimeUs before = (t.event.t_us - 1) / 500 * 500;
    const bool at_bar = in_bar(t.event.x, before) || in_bar(t.event.x, before + 500);
    EXPECT_EQ(t.cause == object, at_bar);
    if (t.event.y < kHeight / 2) {
      EXPECT_EQ(t.cause, object);
    }
    of_object += t.cause == object;
  }
  // Every pixel of the upper half once up and down, by ln(2001/201) = 2.298: 11 events each.
  EXPECT_GT(of_object, 22 * kPixels / 2);
  EXPECT_GT(static_cast<double>(told.size()) - of_object, 1000);
}

TEST(Cause, OfTheLightThatASlowPixelStillLetsGoOfIsTheObjectThatHasLeft) {
  // The scene around the bar is still: without the bar there would be no event at all.
  const auto still = [](int x, int, TimeUs t) { return in_bar(x, t) ? 2.0 : 0.2; };
  const auto shown = [](int x, int, TimeUs t) {
    return in_bar(x, t) ? kCauseFirstObject : kCauseScene;
  };
  for (const double follower_hz : {0.0, 200.0}) {
    EventCameraSpec spec = event_camera_preset("ideal");
    spec.photoreceptor_hz = 100;
    spec.photoreceptor_dark_hz = 50;
    spec.follower_hz = follower_hz;
    const auto by_cause = counts(emulate(spec, every(500, 40000), still, shown));
    ASSERT_EQ(by_cause.size(), 1u);
    EXPECT_GT(by_cause.at(kCauseFirstObject), 5 * kPixels);
  }
}

TEST(Cause, IsTheSceneAgainOnceASlowPixelHasLetGoOfTheObjectsLight) {
  // The object is gone from 10 ms on; time constants of 1 to 2 ms. The scene brightens from 50 ms
  // on.
  const auto light = [](int, int, TimeUs t) {
    return t < 10000 ? 2.0 : 0.2 * std::exp(50 * std::max(0.0, seconds(t) - 0.05));
  };
  const auto shown = [](int, int, TimeUs t) { return t < 10000 ? kCauseFirstObject : kCauseScene; };
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 100;
  for (const Told& t : emulate(spec, every(500, 90000), light, shown)) {
    EXPECT_EQ(t.cause, t.event.t_us < 50000 ? kCauseFirstObject : kCauseScene);
  }
}

// The object is there for a millisecond, which the second of two low-passes notices later: it still
// rises when the object has left.
TEST(Cause, OfWhatTwoLowPassesStillHandOnIsTheObjectThatHasLeft) {
  const auto there = [](TimeUs t) { return t >= 500 && t < 1500; };
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = 1e-9;
  spec.photoreceptor_dark_hz = spec.follower_hz = 10;
  spec.contrast_threshold_on = spec.contrast_threshold_off = 0.15;
  const auto by_cause = counts(emulate(
      spec, every(500, 60000), [&](int, int, TimeUs t) { return there(t); },
      [&](int, int, TimeUs t) { return there(t) ? kCauseFirstObject : kCauseScene; }));
  ASSERT_EQ(by_cause.size(), 1u);
  EXPECT_GE(by_cause.at(kCauseFirstObject), kPixels);
}

TEST(Cause, IsKeptByRegionsToo) {
  EventCamera camera(event_camera_preset("ideal"), 4, 1, 1, 0, "top", true);
  const std::vector<float> dark = {1, 1, 1, 1}, bright = {1, 3, 3, 3};
  const std::vector<Cause> scene = {0, 0, 0, 0}, object = {0, 5, 0, 0};
  std::vector<Event> events;
  camera.reset(0, {dark.data(), scene.data()});
  camera.add_region(100, {1, 0, 3, 1}, {bright.data(), object.data()});
  camera.update(200, {bright.data(), scene.data()}, events);
  ASSERT_EQ(events.size(), 15u);
  ASSERT_EQ(camera.causes().size(), 15u);
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(camera.causes()[i], events[i].x == 1 ? 5 : kCauseScene);
  }
}

TEST(Cause, DoesNotChangeTheEvents) {
  EventCameraSpec spec;
  spec.shot_noise_on_hz = 10;
  spec.leak_hz = 10;
  EventCamera without(spec, kWidth, kHeight, 1, 0, "top");
  const auto events = testing::emulate(without, film(kWidth, kHeight, every(500, 24000), bar_film));
  const auto told = emulate(spec, every(500, 24000), bar_film, kScene);
  ASSERT_GT(events.size(), 5000u);
  ASSERT_EQ(told.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(told[i].event, events[i]);
}

TEST(Cause, MustBeGivenWithEveryPictureWhenItIsKept) {
  EventCamera camera(event_camera_preset("ideal"), 2, 1, 1, 0, "top", true);
  const std::vector<float> picture = {1, 1};
  EXPECT_THROW(camera.reset(0, picture.data()), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim
