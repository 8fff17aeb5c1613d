// The self-tests pass for cameras that are what they are said to be.
#include <gtest/gtest.h>

#include <ostream>

#include "sim/check/self_tests.h"
#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

class Preset : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Cameras, Preset, ::testing::Values("sees1", "ideal", "noisy", "low_light"),
                         [](const auto& info) { return info.param; });

TEST_P(Preset, PassesEveryCheck) {
  for (const auto& make_check : sensor_checks(event_camera_preset(GetParam()), 1)) {
    const Check check = make_check();
    EXPECT_EQ(failures(check), Names()) << check.title;
    EXPECT_FALSE(check.lines.empty()) << check.title;
  }
}

TEST(SensorChecks, OfACameraUnlikeThePresetsPass) {
  EventCameraSpec spec;
  spec.contrast_threshold_on = 0.35;
  spec.contrast_threshold_off = 0.15;
  spec.mismatch_sigma = 0.1;
  spec.follower_hz = 800;
  spec.refractory_us = 1000;
  spec.readout_max_hz = 5e5;
  spec.dead_pixel_fraction = 0.01;
  spec.linear_below = 0.01;
  for (const auto& make_check : sensor_checks(spec, 1)) {
    const Check check = make_check();
    EXPECT_EQ(failures(check), Names()) << check.title;
  }
}

TEST(SensorChecks, SayThatWhatIsSwitchedOffIsOff) {
  Names off;
  for (const auto& make_check : sensor_checks(event_camera_preset("ideal"), 1)) {
    const Names names = lines(make_check(), Outcome::kOff);
    off.insert(off.end(), names.begin(), names.end());
  }
  EXPECT_EQ(off, (Names{"clock", "noise.leak", "noise.shot.dark", "noise.shot.bright", "noise.hot",
                        "readout.rate"}));
}

// Whoever films a sensor with such settings is told what cannot be checked, and nothing false.
struct Extreme {
  const char* name;
  void (*change)(EventCameraSpec& spec);
};

void PrintTo(const Extreme& extreme, std::ostream* os) { *os << extreme.name; }

const Extreme kExtremes[] = {
    {"long_dead_time", [](auto& spec) { spec.refractory_us = 300000; }},
    {"latency", [](auto& spec) { spec.latency_us = 99000; }},
    {"log_epsilon", [](auto& spec) { spec.log_epsilon = 1000; }},
    {"linear", [](auto& spec) { spec.linear_below = 10; }},
    {"linear_in_daylight",
     [](auto& spec) {
       spec.illuminance_lux = 200000;
       spec.linear_below = 1000;
       spec.contrast_threshold_on = 0.1;
     }},
    {"very_slow",
     [](auto& spec) {
       spec = event_camera_preset("ideal");
       spec.follower_hz = 1e-4;
     }},
    {"all_dead", [](auto& spec) { spec.dead_pixel_fraction = 1; }},
    {"jitter", [](auto& spec) { spec.jitter_us = 5000; }},
    {"shot_noise", [](auto& spec) { spec.shot_noise_on_hz = 1000; }},
    {"hot_pixels",
     [](auto& spec) {
       spec.hot_pixel_fraction = 0.2;
       spec.hot_pixel_hz = 20000;
     }},
};

class ExtremeCamera : public ::testing::TestWithParam<Extreme> {};

INSTANTIATE_TEST_SUITE_P(Cameras, ExtremeCamera, ::testing::ValuesIn(kExtremes),
                         [](const auto& info) { return info.param.name; });

TEST_P(ExtremeCamera, PassesOrIsNotChecked) {
  EventCameraSpec spec;
  GetParam().change(spec);
  for (const auto& make_check : sensor_checks(spec, 1)) {
    const Check check = make_check();
    EXPECT_EQ(failures(check), Names()) << check.title;
  }
}

}  // namespace
}  // namespace dodgesim
