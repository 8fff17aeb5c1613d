// Flights with several objects, and along waypoints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

TEST(SeveralObjects, SimultaneousOnesPassAtTheirOffsets) {
  const Scenario s = scenario(
      "pilot: none\nfly_oracle: false\nmission: {start_m: [-1, 0, 2]}\nafter_s: 0.2\n"
      "throws:\n"
      "  - {size_m: 0.1, bearing_deg: 20, aim_offset_m: [1, 0.3], launch_s: 0.5, distance_m: 2}\n"
      "  - {object: box, bearing_deg: -20, aim_offset_m: [-1, 0], launch_s: 0.5, distance_m: 3}\n");
  const FlightPlan plan = plan_throw(s, 0);
  ASSERT_EQ(plan.launches.size(), 2u);
  EXPECT_EQ(plan.end_us, plan.launches[1].drawn.arrival_us() + 200000) << "the later one's";
  const FlightRecord record = fly_as("none", s, plan);
  EXPECT_FALSE(record.verdict.nearest.hit);
  for (const Approach& approach : record.verdict.objects) {
    EXPECT_GT(approach.clearance_m, 0.5);
    EXPECT_LT(approach.clearance_m, 1);
  }
}

TEST(SeveralObjects, ConsecutiveOnesComeAtTheirIntervalWithTheirOwnDraws) {
  const Scenario s = scenario(
      "pilot: none\nfly_oracle: false\nafter_s: 0.1\nmission: {start_m: [-1, 0, 2]}\n"
      "throw: {count: 3, interval_s: 0.4, launch_s: 0.5, bearing_deg: !uniform [-30, 30],\n"
      "        aim_offset_m: [1, 0.2], distance_m: 2}\n");
  const ThrowResult result = fly_throw(s, 4);
  EXPECT_EQ(result.objects, 3);
  EXPECT_EQ(result.launch_us, 500000);
  ASSERT_EQ(result.object_rows.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    const ObjectRow& row = result.object_rows[static_cast<std::size_t>(k)];
    EXPECT_EQ(row.throw_index, 4);
    EXPECT_EQ(row.object, k);
    EXPECT_EQ(row.launch_us, 500000 + k * 400000);
    EXPECT_FALSE(row.hit);
    EXPECT_NEAR(static_cast<double>(*row.closest_us), static_cast<double>(row.launch_us) + 333333,
                30000);
    EXPECT_GT(*row.clearance_m, 0.4);
  }
  EXPECT_NE(result.object_rows[0].bearing_deg, result.object_rows[1].bearing_deg);
  EXPECT_NE(result.object_rows[1].bearing_deg, result.object_rows[2].bearing_deg);
}

TEST(SeveralObjects, TheFirstIsTheOneThatFliesAlone) {
  const std::string one =
      "throw: {launch_s: 0.5, bearing_deg: !uniform [-30, 30], speed_mps: "
      "!uniform [4, 6]";
  const ThrowResult alone =
      fly_throw(scenario("pilot: none\nfly_oracle: false\n" + one + "}\n"), 2);
  const ThrowResult first = fly_throw(
      scenario("pilot: none\nfly_oracle: false\n" + one + ", count: 2, interval_s: 3}\n"), 2);
  EXPECT_EQ(alone.bearing_deg, first.bearing_deg);
  EXPECT_EQ(alone.flown.hit_us, first.flown.hit_us);
  EXPECT_TRUE(first.object_rows[0].hit && first.object_rows[0].none_hit);
  EXPECT_FALSE(first.object_rows[1].hit) << "the flight is over";
  EXPECT_FALSE(first.object_rows[1].closest_us.has_value());
}

TEST(SeveralObjects, AHitByASecondOneIsAHit) {
  const ThrowResult result =
      fly_throw(scenario("pilot: none\nfly_oracle: false\nmission: {start_m: [-1, 0, 2]}\n"
                         "throws: [{aim_offset_m: [1.2, 0], launch_s: 0.5}, {launch_s: 0.6}]\n"),
                0);
  EXPECT_TRUE(result.flown.hit);
  EXPECT_TRUE(result.none.hit);
  EXPECT_FALSE(result.object_rows[0].none_hit);
  EXPECT_TRUE(result.object_rows[1].none_hit);
  EXPECT_EQ(result.object_rows[1].hit_us, result.flown.hit_us);
}

// Contact forces between bodies inside each other would throw them faster than was asked for.
TEST(SeveralObjects, DoNotStartInsideEachOther) {
  const auto flown = [](const std::string& keys) {
    return fly_throw(scenario("pilot: none\nfly_oracle: false\nroom: field\nafter_s: 0.1\n"
                              "throw: {size_m: 0.2, distance_m: 3, launch_s: 0.1, " +
                              keys + "}\n"),
                     0)
        .flown;
  };
  const FlightResult alone = flown("count: 1");
  ASSERT_TRUE(alone.hit);
  EXPECT_THAT(flown("count: 2").error,
              HasSubstr("Object 1 would be launched at 0.1 s where it is 0.2 m inside object 0: "));
  EXPECT_THAT(flown("count: 2, interval_s: 0.02").error, HasSubstr("inside object 0"));
  EXPECT_EQ(flown("count: 2, interval_s: 0.05").hit_us, alone.hit_us);
}

TEST(SeveralObjects, DoNotStartInsideTheRoom) {
  const auto flown = [](const std::string& keys) {
    return fly_throw(scenario("pilot: none\nfly_oracle: false\nafter_s: 0.1\n"
                              "throw: {launch_s: 0.1, " +
                              keys + "}\n"),
                     0)
        .flown;
  };
  EXPECT_THAT(flown("size_m: 0.4, launch_height_m: 0.15").error,
              HasSubstr("0.05 m inside the room's"));
  EXPECT_TRUE(flown("size_m: 0.4, launch_height_m: 0.25").ok());
}

TEST(SeveralObjects, TheOracleSeesThemAll) {
  const Scenario s = scenario(
      "pilot: oracle\noracle: {range_cap_m: 2.5}\nmission: {start_m: [-1, 0, 2]}\nafter_s: 0.3\n"
      "throws: [{bearing_deg: 10, launch_s: 0.5, size_m: 0.1}, {bearing_deg: -10, launch_s: 1.5, "
      "size_m: 0.1}]\n");
  const ThrowResult result = fly_throw(s, 0);
  EXPECT_TRUE(result.none.hit);
  EXPECT_TRUE(result.flown.unharmed());
  for (const ObjectRow& row : result.object_rows) EXPECT_GT(row.clearance_m.value_or(0), 0);
}

TEST(SeveralObjects, ThePapersPilotSeesBothOfTwo) {
  const Scenario s = scenario(
      "mission: {start_m: [-1, 0, 2]}\ndodger: {position: {max_range_m: 3}}\n"
      "throws:\n"
      "  - {bearing_deg: 12, aim_offset_m: [0.7, 0], launch_s: 0.2, size_m: 0.3, distance_m: 2.5}\n"
      "  - {bearing_deg: -12, aim_offset_m: [-0.7, 0], launch_s: 0.2, size_m: 0.3, distance_m: "
      "2.5}\n");
  FlightPlan plan = plan_throw(s, 0);
  plan.end_us = 240000;
  const FlightRecord record = fly(s, plan);
  ASSERT_EQ(record.detections.first_of_object.size(), 2u);
  for (const auto& first : record.detections.first_of_object) {
    ASSERT_TRUE(first.has_value());
    EXPECT_GE(first->output_us, record.detections.first->output_us);
    EXPECT_NEAR(first->distance_m, 2.5, 0.2);
  }
}

TEST(Waypoints, AreFlownInOrderAndTheLastIsKept) {
  const Scenario s = scenario(
      "duration_s: 9\npilot: none\nroom: field\n"
      "mission: {type: waypoints, start_m: [0, 0, 2], speed_mps: 1.5,\n"
      "          waypoints_m: [[2, 0, 2], [2, 2, 3], [0, 2, 2]], waypoint_radius_m: 0.2}\n");
  FlightPlan plan = plan_throw(s, 0);
  Diary diary;
  fly(s, plan, &diary);
  std::size_t next = 0;
  for (const Snapshot& now : diary.snapshots()) {
    const Vector3d& goal = s.mission.waypoints_m[std::min<std::size_t>(next, 2)];
    if ((now.vehicle.p_W - goal).norm() < 0.3) ++next;  // 0.1 m of the estimate's error and delay
  }
  EXPECT_GE(next, 3u);
  const BodyState& last = diary.snapshots().back().vehicle;
  EXPECT_LT((last.p_W - Vector3d(0, 2, 2)).norm(), 0.2);
  EXPECT_LT(last.v_W.norm(), 0.3);
}

}  // namespace
}  // namespace dodgesim
