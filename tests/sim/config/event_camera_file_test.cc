// Event cameras by the names of presets, of files of their own, and of scenarios.
#include "sim/config/event_camera_file.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

class EventCameraFileTest : public ::testing::Test {
 protected:
  EventCameraSpec written(const std::string& yaml, const std::string& name = "mine.yaml") const {
    testing::put(own_.path() / name, yaml);
    return named_event_camera((own_.path() / name).string());
  }

  testing::TemporaryDirectory own_;
};

TEST_F(EventCameraFileTest, HoldsTheKeysOfACameraAndThoseOfItsPreset) {
  const EventCameraSpec camera = written("preset: noisy\nleak_hz: 0.7\n");
  EXPECT_EQ(camera.leak_hz, 0.7);
  EXPECT_EQ(camera.refractory_us, event_camera_preset("noisy").refractory_us);
}

TEST_F(EventCameraFileTest, MayBeAScenarioWhoseCameraIsMeant) {
  const EventCameraSpec camera =
      written("pilot: none\nroom: field\nsensors: {events: {preset: ideal, latency_us: 7}}\n");
  EXPECT_EQ(camera.latency_us, 7);
  EXPECT_EQ(camera.leak_hz, 0);
  EXPECT_EQ(written("extends: mine.yaml\nseed: 3\n", "other.yaml").latency_us, 7);
  EXPECT_EQ(written("throw: {speed_mps: 5}\n").preset, "sees1");
}

TEST_F(EventCameraFileTest, OfAScenarioWithSeveralCamerasIsNone) {
  for (const std::string keys : {"grid", "sweep"}) {
    EXPECT_EQ(testing::complaint<ScenarioError>(
                  [&] { written(keys + ": {sensors.events.preset: [ideal, noisy]}\n"); }),
              (own_.path() / "mine.yaml").string() +
                  " varies sensors.events.preset: write a file with one event camera only.");
  }
  EXPECT_EQ(written("sweep: {delays.compute_us: [0, 3500]}\n").preset, "sees1");
  EXPECT_EQ(written("sweep: {sensors.events.preset: [noisy]}\n").preset, "noisy");
}

TEST_F(EventCameraFileTest, GivesAllSensorsOfAScenario) {
  const auto sensors = [&](const std::string& yaml) {
    testing::put(own_.path() / "mine.yaml", yaml);
    return named_sensors((own_.path() / "mine.yaml").string());
  };
  const SensorsSpec found = sensors("sensors: {sampling: {max_displacement_px: 2}}\n");
  EXPECT_EQ(found.sampling.max_displacement_px, 2);
  EXPECT_EQ(found.events.preset, "sees1");
  EXPECT_EQ(sensors("preset: ideal\n").events.preset, "ideal");
  EXPECT_EQ(sensors("preset: ideal\n").sampling.max_displacement_px,
            SamplingSpec{}.max_displacement_px);
  EXPECT_NE(testing::complaint<ScenarioError>([&] {
              sensors("sweep: {sensors.sampling.max_displacement_px: [1, 2]}\n");
            }).find("sensors.sampling.max_displacement_px"),
            std::string::npos);
}

TEST_F(EventCameraFileTest, OfAScenarioIsReadAsOne) {
  EXPECT_EQ(
      testing::complaint<ScenarioError>([&] { written("sensors: {events: {latency_us: -7}}\n"); }),
      (own_.path() / "mine.yaml").string() +
          ":1:32: sensors.events.latency_us is -7, but must be between 0 and 100000.");
}

}  // namespace
}  // namespace dodgesim
