#include "sim/config/check_presets.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/sim/config/parse.h"

namespace dodgesim {
namespace {

std::string complaint(const std::string& yaml) {
  return testing::complaint<ScenarioError>([&] { parse(yaml); });
}

constexpr const char* kPilots = "sweep: {pilot: [falanga2020, dodgesim]}\n";

TEST(CheckPresets, AKeyThatOnePilotOfASweepWouldLoseIsRefusedOnce) {
  EXPECT_EQ(complaint(std::string("dodger: {time_image: {threshold_b: 0.9}}\n") + kPilots),
            "test.yaml:1:36: dodger.time_image.threshold_b is given, but pilot dodgesim brings its "
            "own; to hold for all values of pilot it must stand there, too, as a list of "
            "one value.");
  EXPECT_EQ(complaint(kPilots), "");
}

// Also with the value that the scenario's own pilot has, and if that is none of the sweep's.
TEST(CheckPresets, WhoseValueItIsDoesNotMatter) {
  EXPECT_NE(complaint(std::string("dodger: {position: {max_range_m: 1.5}}\n") + kPilots), "");
  EXPECT_NE(complaint("dodger: {position: {max_range_m: 2}}\nsweep: {pilot: [dodgesim]}\n"), "");
  EXPECT_EQ(complaint("pilot: dodgesim\ndodger: {position: {max_range_m: 2}}\n"
                      "sweep: {pilot: [dodgesim]}\n"),
            "");
}

TEST(CheckPresets, PilotsThatStartFromOnePresetShareTheKeysOfTheDodger) {
  EXPECT_EQ(complaint("dodger: {position: {max_range_m: 2}}\n"
                      "sweep: {pilot: [falanga2020, oracle, plugin]}\n"),
            "");
}

TEST(CheckPresets, AKeyOfASweptCameraIsRefusedInSweepAndGrid) {
  for (const std::string axis : {"sweep", "grid"}) {
    const std::string cameras = axis + ": {sensors.events.preset: [ideal, sees1]}\nthrow: {}\n";
    EXPECT_EQ(complaint("sensors: {events: {leak_hz: 3}}\n" + cameras),
              "test.yaml:1:29: sensors.events.leak_hz is given, but sensors.events.preset ideal "
              "brings its own; to hold for all values of sensors.events.preset it must stand "
              "there, too, as a list of one value.");
    EXPECT_EQ(complaint("sensors: {camera: {width: 32}}\n" + cameras), "");
  }
}

TEST(CheckPresets, InTheSweepItHoldsForAll) {
  EXPECT_EQ(complaint("sensors: {events: {leak_hz: 3}}\n"
                      "sweep: {sensors.events.preset: [ideal, sees1], sensors.events.leak_hz: [3]}"
                      "\n"),
            "");
}

// It spells out every key, of whichever version it was.
TEST(CheckPresets, AResolvedScenarioCanAlwaysBeRead) {
  Scenario flown = parse(kPilots);
  flown.dodger.time_image.threshold_b = 0.9;
  EXPECT_EQ(complaint(to_yaml(flown)), "");
}

}  // namespace
}  // namespace dodgesim
