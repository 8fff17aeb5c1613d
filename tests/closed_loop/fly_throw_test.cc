// Throws of a campaign with all their pilots, and what becomes of those that fail.
#include "sim/flight/fly_throw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "sim/base/error.h"
#include "tests/closed_loop/flights.h"
#include "tests/models.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

// A vehicle whose flight cannot be computed.
class DivergingVehicle : public ::testing::Test {
 protected:
  DivergingVehicle() { testing::make_diverging(models_); }

  const testing::TemporaryDirectory own_;
  const std::filesystem::path models_ = testing::copy_models(own_.path());
};

// The plan of a throw flies the vehicle to find out where it will be.
TEST_F(DivergingVehicle, FailsTheThrowThatItCannotEvenPlan) {
  const Scenario s =
      parse_scenario("pilot: none\nthrow: {size_m: 0.13}\n", "test.yaml", models_.string());
  EXPECT_THROW(plan_throw(s, 2), SimulationError);
  const ThrowResult result = fly_throw(s, 2);
  EXPECT_TRUE(result.flown.failed());
  EXPECT_THAT(result.flown.error, HasSubstr("The simulation diverged: "));
  EXPECT_EQ(result.none.status, "not flown");
  EXPECT_EQ(result.index, 2);
  EXPECT_EQ(result.object, "ball");
  EXPECT_EQ(result.size_m, 0.13);
}

TEST(FlyThrow, ALaunchFromBehindAWallCostsThatThrowOnly) {
  const Scenario s = scenario(
      "mission: {start_m: [3, 0, 2]}\nthrow: {distance_m: !uniform [2, 4], launch_s: 0.2}\n"
      "pilot: none\n");
  int refused = 0;
  for (int k = 0; k < 8; ++k) {
    const ThrowResult result = fly_throw(s, k);
    const bool behind = result.distance_m > 3;  // the wall
    EXPECT_EQ(result.flown.status, behind ? "error" : "ok") << k;
    if (!behind) continue;
    ++refused;
    EXPECT_THAT(result.flown.error, HasSubstr("wall_front"));
    EXPECT_THAT(result.flown.error, HasSubstr("throw.distance_m"));
    EXPECT_THROW(plan_throw(s, k), ScenarioError);
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 8);
}

TEST(FlyThrow, AnErrorInsideTheSimulationCostsThatFlightOnly) {
  Scenario s = thrown_from_everywhere(kHover, "0");
  s.pilot = "oracle";
  s.fly_oracle = false;
  // The controller's answer to the first evasive command is not a number.
  s.controller.evading_velocity_gain_1ps = std::numeric_limits<double>::infinity();
  const ThrowResult result = fly_throw(s, 0);
  EXPECT_EQ(result.flown.status, "error");
  EXPECT_THAT(result.flown.error, HasSubstr("diverged"));
  EXPECT_EQ(result.none.status, "ok");
  EXPECT_TRUE(result.none.hit);
}

TEST(FlyThrow, AResultSaysWhatWasThrownAndHowItEnded) {
  Scenario s = thrown_from_everywhere(kHover, "[0.1, -0.05]");
  s.pilot = "oracle";
  const ThrowResult result = fly_throw(s, 4);
  const FlightPlan plan = plan_throw(s, 4);
  const Throw& drawn = plan.launches[0].drawn;
  EXPECT_EQ(result.index, 4);
  EXPECT_EQ(result.object, "ball");
  EXPECT_EQ(result.size_m, drawn.object.size_m);
  EXPECT_EQ(result.speed_mps, drawn.speed_mps);
  EXPECT_EQ(result.distance_m, drawn.distance_m);
  EXPECT_EQ(result.bearing_deg, drawn.bearing_deg);
  EXPECT_THAT(result.aim_offset_m, ::testing::ElementsAre(0.1, -0.05));
  EXPECT_EQ(result.launch_us, drawn.launch_us);
  EXPECT_TRUE(result.none.hit);
  EXPECT_EQ(result.none.clearance_m, 0);
  EXPECT_EQ(result.none.closest_us, result.none.hit_us);
  EXPECT_EQ(result.flown.clearance_m, result.oracle.clearance_m);  // the same pilot
  EXPECT_TRUE(result.evaded);
  EXPECT_GT(*result.first_command_us, result.launch_us);
  s.fly_oracle = false;
  EXPECT_EQ(fly_throw(s, 4).oracle.status, "not flown");
}

// Past a vehicle that does not dodge: aimed at a point beside it, or below that under the floor.
TEST(FlyThrow, AResultSaysWhetherTheObjectBouncedBeforeItCame) {
  for (const bool bounces : {true, false}) {
    const ThrowResult result =
        fly_throw(scenario("pilot: none\nmission: {start_m: [0, 0, 0.6]}\nafter_s: 0.2\n"
                           "throw: {distance_m: 2.5, speed_mps: 8, size_m: 0.1, launch_s: 0.2,\n"
                           "  launch_height_m: 0.8, aim_offset_m: [0.8, " +
                           std::string(bounces ? "-1.2" : "0") + "]}\n"),
                  0);
    EXPECT_EQ(result.flown.status, "ok") << result.flown.error;
    EXPECT_FALSE(result.none.hit);
    EXPECT_EQ(result.none_after_room, bounces);
    ASSERT_EQ(result.object_rows.size(), 1u);
    EXPECT_EQ(result.object_rows[0].none_after_room, bounces);
  }
}

TEST(FlyThrow, WithoutAThrowOnlyTheScenariosPilotFlies) {
  const Scenario s = scenario(std::string(kHover) + "duration_s: 0.3\npilot: oracle\n");
  const ThrowResult result = fly_throw(s, 0);
  EXPECT_FALSE(result.thrown());
  EXPECT_EQ(result.flown.status, "ok");
  EXPECT_FALSE(result.flown.clearance_m);
  EXPECT_EQ(result.none.status, "not flown");
  EXPECT_EQ(result.oracle.status, "not flown");
  EXPECT_EQ(result.duration_us, 300000);
  EXPECT_FALSE(result.evaded);
}

}  // namespace
}  // namespace dodgesim
