#include "sim/config/idle_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dodgesim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<std::string> notes_on(const std::string& yaml) {
  return idle_keys(parse_scenario(yaml, "s.yaml", ""));
}

TEST(IdleKeys, AreNamedWithTheirPlaceAndTheReason) {
  EXPECT_THAT(notes_on("fly_oracle: false\noracle: {range_cap_m: 2}\n"),
              ElementsAre("s.yaml:2:23: oracle.range_cap_m has no effect: the pilot oracle does "
                          "not fly."));
  EXPECT_THAT(notes_on("oracle: {range_cap_m: 8}\n"),
              ElementsAre("s.yaml:1:23: oracle.range_cap_m has no effect: dodger.repulsive.eta_0_m "
                          "ends the field nearer."));
  EXPECT_THAT(notes_on("fly_oracle: false\noracle: {range_cap_m: 8}\n"), SizeIs(1));
  EXPECT_THAT(notes_on("oracle: {range_cap_m: 3}\n"), IsEmpty());
  EXPECT_THAT(notes_on("oracle: {range_cap_m: 8}\nsensors: {events: {latency_us: 100000}}\n"),
              IsEmpty())
      << "a fast object is within the field when the oracle learns of it";
  EXPECT_THAT(notes_on("oracle: {range_cap_m: 8}\ndodger: {repulsive: {eta_0_m: 8}}\n"), IsEmpty());
  EXPECT_THAT(notes_on("oracle: {range_cap_m: 8}\npilot: dodgesim\n"), IsEmpty());
  EXPECT_THAT(notes_on("plugin_parameters: fast\n"),
              ElementsAre("s.yaml:1:20: plugin_parameters has no effect: the pilot is not "
                          "plugin."));
  EXPECT_THAT(notes_on("mission: {waypoint_radius_m: 1}\nafter_s: 2\n"),
              ElementsAre("s.yaml:1:30: mission.waypoint_radius_m has no effect: mission.type is "
                          "not waypoints.",
                          "s.yaml:2:10: after_s has no effect: nobody throws, and duration_s is "
                          "the length of a flight."));
  EXPECT_THAT(notes_on("throw: {interval_s: 1}\nduration_s: 2\n"),
              ElementsAre("s.yaml:1:21: throw.interval_s has no effect: throw.count is 1.",
                          "s.yaml:2:13: duration_s has no effect: after_s ends a flight with a "
                          "throw."));
}

TEST(IdleKeys, OfAGroupAreNamedTogether) {
  const std::string escape = "dodger:\n  escape: {keep_probability: 0.1, min_speed_mps: 2";
  EXPECT_THAT(notes_on(escape + ", law: potential_field}\n"),
              ElementsAre("s.yaml:2:30: dodger.escape.keep_probability and "
                          "dodger.escape.min_speed_mps have no effect: dodger.escape.law is "
                          "potential_field."));
  EXPECT_THAT(notes_on("pilot: dodgesim\n" + escape + "}\n"), IsEmpty());
  EXPECT_THAT(notes_on("pilot: plugin\n" + escape + "}\n"), IsEmpty());
}

TEST(IdleKeys, AreThoseOfTheFieldIfTheEscapeIsByTheClosestApproach) {
  const std::string field = "dodger: {repulsive: {gamma: 3, upward: false, k_tau: 0.002}}\n";
  EXPECT_THAT(notes_on(field), IsEmpty());
  EXPECT_THAT(notes_on("pilot: plugin\n" + field), IsEmpty());
  EXPECT_THAT(notes_on("pilot: dodgesim\n" + field),
              ElementsAre("s.yaml:2:29: dodger.repulsive.gamma and dodger.repulsive.upward have no "
                          "effect: dodger.escape.law is closest_approach."));
}

TEST(IdleKeys, AreThoseOfPerceptionIfNobodyPerceives) {
  const std::string keys =
      "dodger: {time_image: {threshold_b: 0.2}, position: {depth: mono}}\n"
      "sensors: {events: {leak_hz: 1, latency_us: 50}}\n";
  EXPECT_THAT(notes_on(keys), IsEmpty());
  for (const char* pilot : {"pilot: oracle\n", "pilot: none\n"}) {
    EXPECT_THAT(notes_on(pilot + keys),
                ElementsAre("s.yaml:2:36: dodger.time_image.threshold_b has no effect: no pilot "
                            "that flies has cameras.",
                            "s.yaml:3:29: sensors.events.leak_hz has no effect: no pilot that "
                            "flies has cameras."));
  }
  EXPECT_THAT(notes_on("sweep: {pilot: [oracle, falanga2020]}\n" + keys), IsEmpty());
}

TEST(IdleKeys, AreThatOfTheLightIfNothingDependsOnIt) {
  EXPECT_THAT(
      notes_on("sensors: {events: {preset: ideal, illuminance_lux: 5}}\n"),
      ElementsAre("s.yaml:1:52: sensors.events.illuminance_lux has no effect: the camera has "
                  "neither photoreceptor_hz nor shot noise."));
  EXPECT_THAT(notes_on("sensors: {events: {illuminance_lux: 5}}\n"), IsEmpty());
}

TEST(IdleKeys, AreThoseOfTheOtherDepth) {
  EXPECT_THAT(notes_on("dodger: {position: {known_size_m: 0.3}}\n"),
              ElementsAre("s.yaml:1:35: dodger.position.known_size_m has no effect: "
                          "dodger.position.depth is stereo."));
  EXPECT_THAT(notes_on("dodger: {position: {side_sigma_px: 3}}\n").size(), 1);
  EXPECT_THAT(notes_on("dodger: {position: {depth: mono, known_size_m: 0.3, side_sigma_px: 3}}\n"),
              IsEmpty());
  const std::string stereo =
      "delays: {lower_camera_us: 500}\nvehicle_overrides: {lower_camera_turn_deg: [0.1, 0, 0]}\n"
      "dodger: {position: {stereo: {search_px: 8}, depth: ";
  EXPECT_THAT(notes_on(stereo + "stereo}}\n"), IsEmpty());
  EXPECT_THAT(notes_on(stereo + "mono}}\n"),
              ElementsAre("s.yaml:3:41: dodger.position.stereo.search_px has no effect: "
                          "dodger.position.depth is mono.",
                          "s.yaml:1:27: delays.lower_camera_us has no effect: "
                          "dodger.position.depth is mono.",
                          "s.yaml:2:44: vehicle_overrides.lower_camera_turn_deg has no effect: "
                          "dodger.position.depth is mono."));
  // A plug-in may use all keys of dodger, but gets no events of a second camera either.
  EXPECT_THAT(notes_on("pilot: plugin\n" + stereo + "mono, known_size_m: 0.5}}\n").size(), 2);
}

TEST(IdleKeys, OfWhatIsSwitchedOffAreNamed) {
  for (const char* yaml :
       {"dodger: {position: {stereo: {disparity: centres, search_px: 8}}}\n",
        "pilot: dodgesim\ndodger: {association: {radius_m: 1}}\n",
        "dodger: {height_monitor: {enabled: false, learn_readings: 10}}\n",
        "dodger: {height_monitor: {enabled: false}, landing: {fresh_us: 200000}}\n",
        "dodger: {height_monitor: {enabled: false}}\nsensors: {range: {rate_hz: 100}}\n",
        "sensors: {events: {preset: ideal, hot_pixel_hz: 500}}\n",
        "sensors: {events: {preset: ideal, photoreceptor_dark_hz: 10}}\n",
        "sensors: {state_estimate: {height_drift_start_s: 1}}\n"}) {
    EXPECT_THAT(notes_on(yaml), SizeIs(1)) << yaml;
    EXPECT_THAT(notes_on(std::string("plugin_parameters: x\n") + yaml), SizeIs(2)) << yaml;
  }
}

TEST(IdleKeys, OfAFlickerAreNamedWithoutOne) {
  const std::string depth = "sensors: {render: {flicker_depth: 0.5";
  EXPECT_THAT(notes_on(depth + "}}\n"),
              ElementsAre("s.yaml:1:35: sensors.render.flicker_depth has no effect: "
                          "sensors.render.flicker_hz is 0."));
  EXPECT_THAT(notes_on(depth + ", flicker_hz: 100}}\n"), IsEmpty());
}

TEST(IdleKeys, ActIfOneValueOfGridOrSweepMakesThem) {
  const std::string oracle = "pilot: none\nfly_oracle: false\noracle: {range_cap_m: 2}\n";
  EXPECT_THAT(notes_on(oracle + "sweep: {pilot: [none, oracle]}\n"), IsEmpty());
  EXPECT_THAT(notes_on("throw: {interval_s: 1}\ngrid: {count: [1, 2]}\n"), IsEmpty());
}

TEST(IdleKeys, AreNoneOfAResolvedScenario) {
  EXPECT_THAT(notes_on(to_yaml(parse_scenario("fly_oracle: false\n", "s.yaml", ""))), IsEmpty());
}

}  // namespace
}  // namespace dodgesim
