// What a camera sees in a flight, as pictures.
#include "sim/observers/luminance_recorder.h"

#include <gtest/gtest.h>

#include <numeric>

#include "sim/recordings/frame_reader.h"
#include "sim/render/flicker.h"
#include "tests/closed_loop/flights.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

// A vehicle that stays in its place sees the same room in the light of each instant.
TEST(LuminanceRecorder, PicturesAreInTheLightOfTheirInstant) {
  const testing::TemporaryDirectory directory;
  const std::string frames = (directory / "f.npy").string(), times = (directory / "t.npy").string();
  const Scenario s =
      scenario(std::string(kHover) +
               "seed: 4\nduration_s: 0.1\nsensors: {camera: {width: 32, height: 24},\n"
               "  render: {flicker_hz: 100, flicker_depth: 0.5}}\n");
  LuminanceRecorder recorder(frames, times, s, 0, 1, 1000);
  fly_as("none", s, &recorder);
  recorder.commit();
  EXPECT_EQ(recorder.count(), 100);

  FrameReader reader(frames, times);
  std::vector<float> luminance;
  std::vector<double> light;  // of the room, without its lamps' swing
  for (TimeUs since_us = 0; reader.next(since_us, luminance);) {
    const double mean = std::accumulate(luminance.begin(), luminance.end(), 0.0) / (32 * 24);
    light.push_back(mean / flicker_factor(s.sensors.render.flicker, flicker_phase_rad(4, 0),
                                          reader.first_us() + since_us));
  }
  ASSERT_EQ(light.size(), 100U);
  EXPECT_GT(light.front(), 0.05);
  for (const double value : light) EXPECT_NEAR(value / light.front(), 1, 0.01);
}

}  // namespace
}  // namespace dodgesim
