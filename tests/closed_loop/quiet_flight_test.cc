// What the pilots take for an object where nobody throws any.
#include <gtest/gtest.h>

#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

// Flying through the room to a goal; `dodger`: keys of the pilot.
bool evades_the_room(const std::string& pilot, int seed, int flight, const std::string& dodger) {
  const Scenario s =
      scenario("pilot: " + pilot + "\nseed: " + std::to_string(seed) +
               "\nrepeats: 100\n"
               "mission: {type: goal, start_m: [-4, 0, 2], goal_m: [4, 0.5, 2], speed_mps: 1.5}\n"
               "duration_s: 6\n"
               "dodger: " +
               dodger + "\n");
  return fly_throw(s, flight).evaded;
}

TEST(QuietFlight, DodgesimDoesNotTakeTheRoomForAnObject) {
  EXPECT_FALSE(evades_the_room("dodgesim", 78, 0, "{}"));
  // It would, if it were satisfied with less.
  EXPECT_TRUE(evades_the_room("dodgesim", 78, 0,
                              "{cluster: {weight_position: 0.6}, escape: {min_speed_mps: 1.5},\n"
                              " association: {gate_sigmas: 0, min_detections: 5}}"));
}

TEST(QuietFlight, ThePapersPilotDoesNotEvadeTwoFalseDetectionsThatFallTogether) {
  EXPECT_FALSE(evades_the_room("falanga2020", 7111, 7, "{}"));
  EXPECT_TRUE(evades_the_room("falanga2020", 7111, 7, "{association: {min_detections: 2}}"))
      << "The two are gone: look for another flight that has some.";
}

}  // namespace
}  // namespace dodgesim
