// What the pilots take for an object where nobody throws any.
#include <gtest/gtest.h>

#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

// In so many seconds of a flight to a goal in the room; `dodger`: keys of the pilot.
bool evades_the_room(const std::string& pilot, int seed, int flight, double duration_s,
                     const std::string& dodger) {
  const std::string root = DODGESIM_SOURCE_DIR;
  const Scenario s = load_scenario(root + "/scenarios/quiet_goal_flight.yaml", root + "/models",
                                   {{"pilot", pilot, ""},
                                    {"seed", std::to_string(seed), ""},
                                    {"repeats", "100", ""},
                                    {"duration_s", std::to_string(duration_s), ""},
                                    {"dodger", dodger, ""}});
  return fly_throw(s, flight).evaded;
}

TEST(QuietFlight, DodgesimDoesNotTakeTheRoomForAnObject) {
  // It would, as in most flights, if it were satisfied with less.
  const std::string less =
      "{cluster: {weight_position_1ppx: 0.6}, escape: {min_speed_mps: 1.5},\n"
      " association: {gate_sigmas: 0, min_detections: 5, tentative_timeout_us: 100000},\n"
      " position: {stereo: {min_share_of_best: 0}}}";
  const int flight = evades_the_room("dodgesim", 78, 3, 2.5, less) ? 3 : 5;
  EXPECT_TRUE(flight == 3 || evades_the_room("dodgesim", 78, 5, 2.5, less))
      << "Not any more: look for other flights.";
  EXPECT_FALSE(evades_the_room("dodgesim", 78, flight, 2.5, "{}"));
}

TEST(QuietFlight, ThePapersPilotDoesNotEvadeSingleFalseDetections) {
  const std::string one = "{association: {min_detections: 1}}";
  const int flight = evades_the_room("falanga2020", 7131, 14, 4, one) ? 14 : 4;
  EXPECT_TRUE(flight == 14 || evades_the_room("falanga2020", 7131, 4, 4, one))
      << "There is none any more: look for flights that have some.";
  EXPECT_FALSE(evades_the_room("falanga2020", 7131, flight, 4, "{}"));
}

}  // namespace
}  // namespace dodgesim
