// Whether throws see through one specimen of the camera or through a new one each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/events/event_camera.h"
#include "tests/sim/events/reference.h"

namespace dodgesim {
namespace {

using testing::emulate;
using testing::every;
using testing::film;

constexpr int kSide = 100;

// What makes a specimen: each pixel's thresholds, whether it is dead, and whether it is hot.
struct Specimen {
  std::vector<float> thresholds;
  std::vector<bool> dead, hot;
};

Specimen specimen(const std::string& device, std::uint64_t throw_index) {
  EventCameraSpec spec;
  spec.device = device;
  spec.shot_noise_on_hz = spec.shot_noise_off_hz = spec.leak_hz = 0;
  spec.hot_pixel_fraction = 0.2;
  spec.hot_pixel_sigma = 0;  // each soon shows that it is hot
  spec.dead_pixel_fraction = 0.2;
  Specimen out;
  EventCamera still(spec, kSide, kSide, 5, throw_index, "top");
  for (int i = 0; i < kSide * kSide; ++i) {
    const PixelState p = still.pixel(i % kSide, i / kSide);
    out.thresholds.push_back(static_cast<float>(p.threshold_on));
  }
  const auto fired = [](EventCamera& camera, auto light) {
    std::vector<bool> pixels(kSide * kSide);
    for (const Event& event : emulate(camera, film(kSide, kSide, every(20000, 400000), light))) {
      pixels[static_cast<std::size_t>(event.y * kSide + event.x)] = true;
    }
    return pixels;
  };
  out.hot = fired(still, [](int, int, TimeUs) { return 1.0; });
  EventCamera waving(spec, kSide, kSide, 5, throw_index, "top");
  out.dead = fired(waving, [](int, int, TimeUs t) { return 1.5 + std::sin(30 * seconds(t)); });
  out.dead.flip();
  return out;
}

// Of the pixels that are so in either, the share that is so in both.
double overlap(const std::vector<bool>& a, const std::vector<bool>& b) {
  int both = 0, either = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    both += a[i] && b[i];
    either += a[i] || b[i];
  }
  return static_cast<double>(both) / either;
}

TEST(Device, IsOneAndTheSameForAllThrowsOfACampaign) {
  const Specimen first = specimen("campaign", 0), later = specimen("campaign", 17);
  EXPECT_EQ(later.thresholds, first.thresholds);
  EXPECT_EQ(later.dead, first.dead);
  EXPECT_EQ(later.hot, first.hot);
}

TEST(Device, IsAnotherOneForEachThrowIfAskedFor) {
  const Specimen first = specimen("throw", 0), later = specimen("throw", 17);
  const Specimen again = specimen("throw", 17);
  EXPECT_EQ(again.thresholds, later.thresholds);
  EXPECT_EQ(again.hot, later.hot);
  // Of independent shares of 0.2 a ninth overlaps; hot pixels that are dead are silent.
  EXPECT_NEAR(overlap(first.dead, later.dead), 1.0 / 9, 0.02);
  EXPECT_LT(overlap(first.hot, later.hot), 0.15);
  EXPECT_GT(std::count(first.hot.begin(), first.hot.end(), true), 1000);
  int same = 0;
  for (std::size_t i = 0; i < first.thresholds.size(); ++i) {
    if (!first.dead[i] && !later.dead[i]) same += first.thresholds[i] == later.thresholds[i];
  }
  EXPECT_LT(same, 10);
}

TEST(DeadPixels, HaveTheSetShareAndAreSilentWhateverHappens) {
  EventCameraSpec spec = event_camera_preset("noisy");
  spec.dead_pixel_fraction = 0.1;
  spec.hot_pixel_fraction = 0.3;
  const auto silent = [&](std::uint64_t throw_index) {
    EventCamera camera(spec, kSide, kSide, 1, throw_index, "top");
    std::vector<int> count(kSide * kSide);
    for (const Event& event :
         emulate(camera, film(kSide, kSide, every(20000, 400000), [](int x, int y, TimeUs t) {
                   return 1.5 + std::sin(30 * seconds(t) + x + 3 * y);
                 }))) {
      ++count[static_cast<std::size_t>(event.y * kSide + event.x)];
    }
    std::vector<bool> is_silent;
    for (const int n : count) is_silent.push_back(n == 0);
    return is_silent;
  };
  const auto first = silent(0);
  const double expected = 0.1 * kSide * kSide;
  EXPECT_NEAR(static_cast<double>(std::count(first.begin(), first.end(), true)), expected,
              3 * std::sqrt(0.9 * expected));
  EXPECT_EQ(silent(7), first);  // they belong to the device
}

}  // namespace
}  // namespace dodgesim
