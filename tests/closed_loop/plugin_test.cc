// Flights of pilots that are loaded from a library.
#include <gtest/gtest.h>

#include "sim/campaign/wire.h"
#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

Scenario flown_by_plugin(const std::string& parameters, const std::string& keys) {
  Scenario flown = scenario("seed: 11\npilot: plugin\nfly_oracle: false\n" + keys);
  flown.plugin = read_plugin(DODGESIM_BINARY_DIR "/tests/plugins/libobedient.so");
  flown.plugin_parameters = parameters;
  return flown;
}

TEST(PilotPlugin, ThatIsThePapersFliesAsThePapers) {
  const std::string keys =
      "throw: {distance_m: 3, speed_mps: 7, launch_s: 0.3, size_m: 0.3}\nafter_s: 0.1\n"
      "sensors: {events: {preset: sees1}, camera: {width: 160, height: 120}}\n";
  const Scenario plugged = flown_by_plugin("be the dodger", keys);
  Scenario built_in = plugged;
  built_in.pilot = kPaperPilot;
  ThrowResult theirs = fly_throw(plugged, 0), ours = fly_throw(built_in, 0);
  EXPECT_GT(ours.detections, 0);
  EXPECT_TRUE(ours.first_command_us);
  theirs.wall_s = ours.wall_s;
  EXPECT_EQ(to_bytes(theirs), to_bytes(ours));
}

TEST(PilotPlugin, GivesTheCommandsThatTheVehicleFollows) {
  Scenario flown =
      flown_by_plugin("", "duration_s: 0.6\nsensors: {camera: {width: 64, height: 48}}\n");
  FlightPlan plan = plan_throw(flown, 0);
  plan.pilot = flown.pilot;
  EXPECT_GT(fly(flown, plan).last.vehicle.p_W.y(), 0.3);
}

}  // namespace
}  // namespace dodgesim
