#include "sim/config/idle_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dodgesim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> notes_on(const std::string& yaml) {
  return idle_keys(parse_scenario(yaml, "s.yaml", ""));
}

TEST(IdleKeys, AreNamedWithTheirPlaceAndTheReason) {
  EXPECT_THAT(notes_on("fly_oracle: false\noracle: {range_cap_m: 2}\n"),
              ElementsAre("s.yaml:2:23: oracle.range_cap_m has no effect: the pilot oracle does "
                          "not fly."));
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
