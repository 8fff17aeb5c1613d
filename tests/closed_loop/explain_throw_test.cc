// What whole flights say about why they ended as they did.
#include <gtest/gtest.h>

#include "sim/flight/explain_throw.h"
#include "sim/outcome/trajectory.h"
#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

// A head-on throw at a hovering vehicle; few pixels, so that cameras cost little.
Scenario head_on(const std::string& pilot, const std::string& toss, double size_m = 0.2,
                 const std::string& more = "") {
  return scenario("pilot: " + pilot + "\nfly_oracle: false\nmission: {start_m: [-2, 0, 2]}\n" +
                  "throw: {size_m: " + std::to_string(size_m) + ", distance_m: 2, launch_s: 0.1, " +
                  toss + "}\n" + "sensors: {camera: {width: 48, height: 36}}\nafter_s: 0.1\n" +
                  more);
}

TEST(ExplainThrow, FromBehindNothingIsSeen) {
  const ThrowResult result = fly_throw(head_on("falanga2020", "speed_mps: 8, bearing_deg: 180"), 0);
  ASSERT_TRUE(result.flown.hit);
  EXPECT_FALSE(result.first_in_view_us);
  EXPECT_EQ(result.cause, "not seen");
}

TEST(ExplainThrow, WhatComesIntoViewMayStayUndetected) {
  const std::string blind = "dodger: {time_image: {threshold_b: 1}}\n";
  const ThrowResult result = fly_throw(head_on("falanga2020", "speed_mps: 8", 0.05, blind), 0);
  ASSERT_TRUE(result.flown.hit);
  // At 28.6 px of focal length it is a pixel wide at 1.43 m: 0.45 m after the launch.
  EXPECT_NEAR(seconds(*result.first_in_view_us), 0.1 + 0.45 / 8, 0.005);
  EXPECT_FALSE(result.first_detection_us);
  EXPECT_EQ(result.cause, "not detected");
  EXPECT_FALSE(result.false_alarm);
}

// At 2 m/s from 2 m a ball rises out of the view, whose half is 32 degrees, while it is 1.76 m
// away: it climbs at 4.9 m/s, and its elevation's tangent is 2.45 times the time [s].
TEST(ExplainThrow, ALobThatLeavesTheViewFarAwayIsSeenFarOnly) {
  const auto cause = [](const std::string& max_range_m) {
    const std::string blind =
        "dodger: {time_image: {threshold_b: 1}, position: {max_range_m: " + max_range_m + "}}\n";
    return fly_throw(head_on("falanga2020", "speed_mps: 2, launch_height_m: 2", 0.2, blind), 0)
        .cause;
  };
  EXPECT_EQ(cause("1.6"), "seen far only");
  EXPECT_EQ(cause("1.9"), "not detected");
}

TEST(ExplainThrow, ToldOfItAtHalfAMetreItIsTooLate) {
  const ThrowResult result =
      fly_throw(head_on("oracle", "speed_mps: 8", 0.2, "oracle: {range_cap_m: 0.8}\n"), 0);
  ASSERT_TRUE(result.flown.hit);
  EXPECT_EQ(result.cause, "seen late");
  EXPECT_LT(*result.escape_left_s, *result.escape_needed_s);
  // Upward 8 cm of camera housing and 10 cm of ball take 0.155 s with the motors' lag. The ball is
  // below the housing only some 15 ms after the contact, and a tilt takes the hull out of its way.
  EXPECT_NEAR(*result.escape_needed_s, 0.12, 0.02);
}

// What a vehicle dodged was not too late.
TEST(ExplainThrow, WhoDodgesHadAtLeastTheTimeThatIsNeeded) {
  int dodged = 0, narrow = 0;
  for (const char* speed : {"5", "6", "7", "8"}) {
    for (const char* range : {"1.1", "1.3", "1.5", "1.7"}) {
      const ThrowResult result =
          fly_throw(head_on("oracle", std::string("speed_mps: ") + speed, 0.2,
                            std::string("oracle: {range_cap_m: ") + range +
                                "}\ndodger: {escape: {law: closest_approach}}\n"),
                    0);
      if (!result.flown.unharmed()) continue;
      ++dodged;
      EXPECT_GE(*result.escape_left_s, *result.escape_needed_s) << speed << " " << range;
      narrow += *result.escape_left_s < *result.escape_needed_s + 0.05;
    }
  }
  EXPECT_GE(dodged, 4);
  EXPECT_GE(narrow, 1);  // otherwise this says nothing
}

// 0.5 s to the contact, of which some 0.14 s are needed, and 0.19 m.
TEST(ExplainThrow, APilotThatAsksForASlowEscapeCommandsTooLittle) {
  const std::string slow = "dodger: {velocity_limit: {max_speed_mps: 0.3}}\n";
  const ThrowResult result = fly_throw(head_on("oracle", "speed_mps: 4", 0.2, slow), 0);
  ASSERT_TRUE(result.flown.hit);
  EXPECT_GT(*result.escape_left_s, *result.escape_needed_s);
  EXPECT_EQ(result.cause, "commanded too little");
}

TEST(ExplainThrow, AControllerThatDoesNotFollowDoesNotUseTheThrust) {
  const std::string dull = "controller: {evading_velocity_gain_1ps: 0.3}\n";
  const ThrowResult result = fly_throw(head_on("oracle", "speed_mps: 4", 0.2, dull), 0);
  ASSERT_TRUE(result.flown.hit);
  EXPECT_EQ(result.cause, "not enough thrust");
}

// The first ball, which would miss, is evaded before the second one is thrown; of that one the
// pilot is told at 1 m, 0.08 s before it comes.
TEST(ExplainThrow, ToldOfTwoObjectsItsAnswerToTheSecondIsNoneToTheFirst) {
  const ThrowResult result = fly_throw(
      scenario("pilot: oracle\nfly_oracle: false\nroom: field\noracle: {range_cap_m: 1}\n"
               "mission: {start_m: [-2, 0, 2]}\nafter_s: 0.1\nthrows:\n"
               "  - {speed_mps: 5, distance_m: 3, launch_s: 0.2, aim_offset_m: [0.9, 0]}\n"
               "  - {speed_mps: 12, distance_m: 3, launch_s: 0.9, size_m: 0.3}\n"
               "controller: {evading_velocity_gain_1ps: 0.3}\n"),
      0);
  ASSERT_TRUE(result.flown.hit);
  ASSERT_LT(*result.first_command_us, 900000);
  EXPECT_LT(*result.escape_left_s, 0.08);
  EXPECT_EQ(result.cause, "second object");
}

// Nobody flew this: a ball of 20 cm comes along x at a vehicle that is a point, and hits it after
// 1 s.
FlightRecord head_on_hit() {
  FlightRecord record;
  record.verdict.nearest.hit = true;
  record.verdict.nearest.hit_us = 1000000;
  record.verdict.nearest_object = 0;
  record.last.objects.resize(1);
  record.last.objects[0].p_W.x() = 0.101;
  record.last.objects[0].v_W.x() = -6;
  record.hull = {Convex::sphere(Eigen::Vector3d::Zero(), 1e-3)};
  record.shapes = {{Convex::sphere(Eigen::Vector3d::Zero(), 0.1)}};
  record.agility = {38, 404, 0.04, 0};
  return record;
}

// Why it hits one that is commanded so.
std::string cause_of(const std::vector<FlightLog::Command>& commands) {
  const FlightRecord none = head_on_hit();
  FlightRecord flown = none;
  flown.log.objects.resize(1);
  flown.log.objects[0].known_us = 0;
  flown.log.commands = commands;
  flown.first_command_us = commands.front().t_us;
  FlightPlan plan;
  plan.pilot = "oracle";
  ThrowResult result;
  result.flown.hit = true;
  explain_throw(plan, &none, flown, result);
  return result.cause;
}

TEST(ExplainThrow, WhereTheCommandsLeadDecidesWhetherTheyWereEnough) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), still = Eigen::Vector3d::Zero();
  // 0.1 m are needed, in 0.5 s.
  EXPECT_EQ(cause_of({{500000, true, 0.21 * up, still}}), "not enough thrust");
  EXPECT_EQ(cause_of({{500000, true, 0.19 * up, still}}), "commanded too little");
  EXPECT_EQ(cause_of({{400000, false, 5 * up, still}, {500000, true, 0.19 * up, still}}),
            "commanded too little");
  // It rose anyway.
  EXPECT_EQ(cause_of({{500000, true, 0.3 * up, 0.11 * up}}), "commanded too little");
  EXPECT_EQ(cause_of({{500000, true, 0.3 * up, 0.09 * up}}), "not enough thrust");
  // It stops, for good or for a while.
  EXPECT_EQ(cause_of({{500000, true, up, still}, {590000, false, still, up}}),
            "commanded too little");
  EXPECT_EQ(cause_of({{500000, true, up, still}, {610000, false, still, up}}), "not enough thrust");
  EXPECT_EQ(
      cause_of({{500000, true, up, still}, {590000, false, still, up}, {980000, true, up, still}}),
      "not enough thrust");
  // What comes after the ball is of no use.
  EXPECT_EQ(cause_of({{500000, true, 0.19 * up, still}, {1000000, true, 5 * up, still}}),
            "commanded too little");
  EXPECT_EQ(cause_of({{500000, true, 0.21 * up, still}, {1000000, true, -5 * up, still}}),
            "not enough thrust");
}

TEST(ExplainThrow, AnEscapeThatTurnsBackIsNoLackOfThrust) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), left = Eigen::Vector3d::UnitY(),
                        still = Eigen::Vector3d::Zero();
  EXPECT_EQ(cause_of({{500000, true, up, still}, {520000, true, left - 0.1 * up, up}}),
            "direction turned");
  EXPECT_EQ(cause_of({{500000, true, up, still}, {520000, true, left + 0.1 * up, up}}),
            "not enough thrust");
  // Too late for the rotors, or so that it is led back.
  EXPECT_EQ(cause_of({{500000, true, up, still}, {990000, true, left - 0.1 * up, up}}),
            "not enough thrust");
  EXPECT_EQ(cause_of({{500000, true, up, still}, {800000, true, -1.5 * up, up}}),
            "direction turned");
  // Not far enough before it turned, either.
  EXPECT_EQ(cause_of({{500000, true, 0.19 * up, still}, {520000, true, -0.2 * up, up}}),
            "commanded too little");
  // It corrects itself.
  EXPECT_EQ(cause_of({{500000, true, {0, 0, -0.1}, still}, {504000, true, up, still}}),
            "not enough thrust");
  // After the ball.
  EXPECT_EQ(cause_of({{500000, true, up, still}, {1000000, true, -up, up}}), "not enough thrust");
  // Not an evasive one; it only stops.
  EXPECT_EQ(cause_of({{500000, true, up, still}, {620000, false, -0.01 * up, up}}),
            "not enough thrust");
}

// Nobody flew this either: the first object is in view from 0.1 s on, the second from 0.3 s, and
// is detected at 0.5 s. `hitter` would have hit after 1 s.
ThrowResult two_objects(int hitter, bool second_detected) {
  FlightRecord none;
  none.verdict.nearest_object = hitter;
  FlightRecord flown = none;
  flown.log.objects.resize(2);
  flown.log.objects[0].in_view_us = 100000;
  flown.log.objects[1].in_view_us = 300000;
  FlightPlan plan;
  plan.pilot = "none";
  ThrowResult result;
  result.none.hit_us = 1000000;
  if (second_detected) flown.detections.first = DetectionLog::First{500000, 490000, 2, 1};
  explain_throw(plan, &none, flown, result);
  return result;
}

TEST(ExplainThrow, TheTimesOfADetectionAreThoseOfTheObjectThatWasDetectedFirst) {
  EXPECT_EQ(two_objects(0, false).first_in_view_us, 100000);
  EXPECT_FALSE(two_objects(0, false).time_to_contact_us);
  EXPECT_EQ(two_objects(1, true).first_in_view_us, 300000);
  EXPECT_EQ(two_objects(1, true).time_to_contact_us, 500000);
  EXPECT_FALSE(two_objects(0, true).time_to_contact_us);
}

// Detected at 0.5 s; the first evasive command is on its way for 0.1 s and arrives then.
bool is_false_alarm(TimeUs first_command_us) {
  FlightRecord flown;
  flown.log.objects.resize(1);
  flown.detections.first = DetectionLog::First{500000, 490000, 2, 0};
  flown.command_delay_us = 100000;
  FlightPlan plan;
  plan.pilot = "falanga2020";
  plan.launches.resize(1);
  ThrowResult result;
  result.first_command_us = first_command_us;
  explain_throw(plan, nullptr, flown, result);
  return result.false_alarm;
}

TEST(ExplainThrow, WhatWasSentBeforeTheDetectionIsAFalseAlarm) {
  EXPECT_TRUE(is_false_alarm(499750));
  EXPECT_TRUE(is_false_alarm(599750));
  EXPECT_FALSE(is_false_alarm(600000));
}

// Detected at 0.5 s; an evasive command arrives every 0.05 s, after 0.1 s.
TEST(ExplainThrow, AnAnswerIsSentAfterTheDetection) {
  const FlightRecord none = head_on_hit();
  FlightRecord flown = none;
  flown.command_delay_us = 100000;
  flown.log.objects.resize(1);
  flown.log.objects[0].known_us = 500000;
  for (TimeUs t_us = 450000; t_us < 900000; t_us += 50000) {
    flown.log.commands.push_back({t_us, true, Eigen::Vector3d::UnitZ(), {0, 0, 0}});
  }
  FlightPlan plan;
  plan.pilot = "falanga2020";
  plan.launches.resize(1);
  ThrowResult result;
  result.flown.hit = true;
  explain_throw(plan, &none, flown, result);
  EXPECT_NEAR(*result.escape_left_s, 0.4, 1e-9);
}

TEST(ExplainThrow, ADodgeHasNoCause) {
  const ThrowResult result = fly_throw(head_on("oracle", "speed_mps: 4"), 0);
  ASSERT_TRUE(result.flown.unharmed());
  EXPECT_EQ(result.cause, "");
}

TEST(ExplainThrow, NobodyBlamesThePilotThatDoesNothing) {
  EXPECT_EQ(fly_throw(head_on("none", "speed_mps: 8"), 0).cause, "");
}

TEST(ExplainThrow, TheTrajectoryShowsTheFlightUntilTheHit) {
  const ThrowResult result = fly_throw(head_on("none", "speed_mps: 8"), 0);
  const Trajectory trajectory = trajectory_from_bytes(result.trajectory);
  EXPECT_EQ(trajectory.start_us, kTickUs);  // 0.1 s before the launch, but for the first tick
  EXPECT_EQ(trajectory.end_us, *result.flown.hit_us);
  EXPECT_EQ(trajectory.sizes_m, std::vector<double>{0.2});
  const Trajectory::Sample& last = trajectory.samples.back();
  const double reach_m = (last.p_W - last.objects[0].value()).norm();
  EXPECT_GT(reach_m, 0.1);
  EXPECT_LT(reach_m, 0.1 + 0.26);  // ball and hull
  ASSERT_EQ(trajectory.period_us, 20000);
  EXPECT_FALSE(trajectory.samples[4].objects[0]);
  // Sample i is of the instant start + i * period: between the ball's places on its way.
  const double speed_mps = 8, launch_s = 0.1;
  const auto flown_m = [&](std::size_t i) {
    const double t_s = seconds(trajectory.start_us) + 0.02 * static_cast<double>(i);
    return speed_mps * (t_s - launch_s);
  };
  const auto x_m = [&](std::size_t i) { return trajectory.samples[i].objects[0].value().x(); };
  EXPECT_NEAR(x_m(6) - x_m(5), flown_m(5) - flown_m(6), 0.02);
  EXPECT_NEAR(x_m(5), x_m(9) + flown_m(9) - flown_m(5), 0.05);
  EXPECT_NEAR(x_m(5) - trajectory.samples[5].p_W.x(), 2 - flown_m(5), 0.05);
  EXPECT_LT(result.trajectory.size(), 400u);
}

TEST(ExplainThrow, AQuietFlightOfTheOracleIsNoFalseAlarm) {
  const ThrowResult result = fly_throw(scenario("pilot: oracle\nduration_s: 0.5\n"), 0);
  EXPECT_FALSE(result.false_alarm);
  EXPECT_EQ(trajectory_from_bytes(result.trajectory).end_us, 500000);
}

}  // namespace
}  // namespace dodgesim
