// Whole flights of the pilots that need no eyes: physics, delays, controller, throws, referee.
#include "sim/loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "sim/base/error.h"
#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

constexpr const char* kGoalFlight =
    "mission: {type: goal, start_m: [-5, 0, 2], goal_m: [4, 1, 2], speed_mps: 1.5}\n";

class Throws : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Missions, Throws, ::testing::Values(kHover, kGoalFlight),
                         [](const auto& info) { return info.index == 0 ? "Hover" : "GoalFlight"; });

TEST_P(Throws, HitAVehicleThatDoesNotDodgeWhenTheyAreAimedAtIt) {
  const Scenario s = thrown_from_everywhere(GetParam(), "0");
  for (int k = 0; k < 4; ++k) {
    const FlightPlan plan = plan_throw(s, k);
    const Throw& drawn = plan.launches.at(0).drawn;
    const FlightRecord record = fly_as("none", s, plan);
    ASSERT_TRUE(record.verdict.nearest.hit) << "throw " << k;
    // The surfaces meet before the centres do, by the radii of both (the arms reach 0.35 m).
    const TimeUs early_us = drawn.arrival_us() - *record.verdict.nearest.hit_us;
    const double reach_m = 0.5 * drawn.object.size_m + 0.35;
    EXPECT_GT(early_us, 0) << "throw " << k;
    EXPECT_LT(seconds(early_us), reach_m / (drawn.speed_mps - 1.5)) << "throw " << k;
    EXPECT_EQ(record.last.t_us, record.verdict.nearest.hit_us);  // the flight ends there
  }
}

TEST_P(Throws, PassTheVehicleAtTheAimOffsetAtThePlannedInstant) {
  const Scenario s = thrown_from_everywhere(GetParam(), "[1, 0.5]");
  for (int k = 0; k < 4; ++k) {
    const FlightPlan plan = plan_throw(s, k);
    Diary diary;
    const FlightRecord record = fly_as("none", s, plan, &diary);
    EXPECT_FALSE(record.verdict.nearest.hit) << "throw " << k;
    EXPECT_GT(record.verdict.nearest.clearance_m, 0.3) << "throw " << k;
    const auto& [drawn, launch] = plan.launches.at(0);
    const Snapshot arrival = diary.at(drawn.arrival_us());
    // Left and up across the line of flight, for a viewer who looks at the launch point.
    const Vector3d vehicle_W = arrival.vehicle.p_W;
    const Vector3d aim_W = arrival.objects[0].p_W;
    Vector3d line_W = launch.p_W - aim_W;
    line_W.z() = 0;
    EXPECT_NEAR(line_W.norm(), drawn.distance_m, 2e-3) << "throw " << k;
    const Vector3d x_W = arrival.vehicle.q_W * Vector3d::UnitX();
    const double bearing_rad = std::atan2(line_W.y(), line_W.x()) - std::atan2(x_W.y(), x_W.x());
    EXPECT_NEAR(bearing_rad * 180 / M_PI, drawn.bearing_deg, 0.1) << "throw " << k;
    const Vector3d left_W = Vector3d::UnitZ().cross(line_W.normalized());
    EXPECT_LT((aim_W - vehicle_W - left_W - Vector3d(0, 0, 0.5)).norm(), 2e-3) << "throw " << k;
  }
}

TEST_P(Throws, AreLaunchedOnTheirTickInTheirState) {
  const Scenario s = thrown_from_everywhere(GetParam(), "0");
  const FlightPlan plan = plan_throw(s, 1);
  const auto& [drawn, launch] = plan.launches.at(0);
  ASSERT_EQ(drawn.launch_us % kTickUs, 0);
  Diary diary;
  fly_as("none", s, plan, &diary);
  const Snapshot before = diary.snapshots().at(static_cast<std::size_t>(drawn.launch_us / 250 - 1));
  const Snapshot after = diary.snapshots().at(static_cast<std::size_t>(drawn.launch_us / 250));
  EXPECT_EQ(before.t_us, drawn.launch_us);
  EXPECT_FALSE(before.launched[0]);
  EXPECT_TRUE(after.launched[0]);
  EXPECT_LT((after.objects[0].p_W - launch.p_W - seconds(kTickUs) * launch.v_W).norm(), 1e-5);
}

TEST(Loop, TheOracleDodgesMediumThrows) {
  const Scenario s = scenario(std::string(kHover) +
                              "throw: {distance_m: 3.5, speed_mps: !uniform [5, 6], size_m: 0.2,\n"
                              "  bearing_deg: !uniform [-20, 20], launch_s: 0.2}\nafter_s: 0.2\n");
  for (int k = 0; k < 5; ++k) {
    const FlightPlan plan = plan_throw(s, k);
    const FlightRecord none = fly_as("none", s, plan);
    EXPECT_TRUE(none.verdict.nearest.hit) << "throw " << k;
    EXPECT_FALSE(none.first_command_us);
    const FlightRecord oracle = fly_as("oracle", s, plan);
    EXPECT_FALSE(oracle.verdict.nearest.hit) << "throw " << k;
    EXPECT_FALSE(oracle.verdict.crashed) << "throw " << k;
    ASSERT_TRUE(oracle.first_command_us) << "throw " << k;
  }
}

TEST(Loop, LatencyDecidesWhetherADodgeSucceeds) {
  const std::string text = std::string(kHover) +
                           "pilot: oracle\nthrow: {distance_m: 2.5, speed_mps: 6, size_m: 0.3,\n"
                           "  bearing_deg: !uniform [-20, 20], launch_s: 0.2}\nafter_s: 0.2\n";
  const Scenario quick = scenario(text + "delays: {transport_us: 1000, command_us: 3000}\n");
  const Scenario slow = scenario(text + "delays: {transport_us: 100000, command_us: 100000}\n");
  int hits_quick = 0, hits_slow = 0;
  for (int k = 0; k < 4; ++k) {
    const FlightPlan plan = plan_throw(quick, k);
    hits_quick += fly_as("oracle", quick, plan).verdict.nearest.hit;
    hits_slow += fly_as("oracle", slow, plan_throw(slow, k)).verdict.nearest.hit;
  }
  EXPECT_EQ(hits_quick, 0);
  EXPECT_EQ(hits_slow, 4);
}

// The first evasive command reaches the rotors after every link of the chain, and then at once.
TEST(Loop, TheFirstCommandComesAfterTheSumOfTheDelays) {
  for (const int link_us : {1000, 20000}) {
    Scenario s = scenario(std::string(kHover) +
                          "throw: {distance_m: 2.5, speed_mps: 6, launch_s: 0.2}\nafter_s: 0.2\n");
    s.delays.transport_us = link_us;
    s.delays.compute_us = 4 * link_us;
    s.delays.command_us = 2 * link_us;
    s.delays.flight_controller_us = 3 * link_us;
    const FlightPlan plan = plan_throw(s, 0);
    const FlightRecord record = fly_as("oracle", s, plan);
    ASSERT_TRUE(record.first_command_us);
    const TimeUs latency_us = *record.first_command_us - plan.launches[0].drawn.launch_us;
    const DelaySpec& d = s.delays;
    const TimeUs chain_us = s.sensors.events.latency_us + d.transport_us + d.compute_us +
                            d.command_us + d.flight_controller_us;
    EXPECT_GE(latency_us, chain_us);
    // The truth is looked at every 1 ms.
    const TimeUs period_us = std::max(d.cycle_us, d.compute_us);
    EXPECT_LE(latency_us, chain_us + period_us + 1000 + kTickUs);
  }
}

// A controller that acted at state estimates alone would do so in steps of 4 ms.
TEST(Loop, TheFirstCommandComesAsMuchLaterAsThePilotComputesLonger) {
  const auto first_us = [](int compute_us) {
    Scenario s = scenario(std::string(kHover) +
                          "throw: {distance_m: 2.5, speed_mps: 6, launch_s: 0.2}\nafter_s: 0.2\n");
    s.delays.compute_us = compute_us;
    return *fly_as("oracle", s, plan_throw(s, 0)).first_command_us;
  };
  const TimeUs at_once_us = first_us(0);
  for (const int compute_us : {500, 1000, 2250, 3500}) {
    EXPECT_EQ(first_us(compute_us), at_once_us + compute_us);
  }
}

// When the controller's first command reaches the flight controller.
class FirstCommand : public FlightObserver {
 public:
  void on_command(TimeUs now_us, bool /*evading*/) override {
    if (!us) us = now_us;
  }
  std::optional<TimeUs> us;
};

// The controller acts at the first state estimate, of 4 ms, and once it has that.
TEST(Loop, TheControllerWaitsForTheStateEstimate) {
  for (const int state_estimate_us : {0, 2000, 10000}) {
    Scenario s = scenario(std::string(kHover) + "duration_s: 0.1\npilot: none\n");
    s.delays.state_estimate_us = state_estimate_us;
    FirstCommand first;
    fly(s, plan_throw(s, 0), &first);
    const DelaySpec& d = s.delays;
    EXPECT_EQ(first.us, 4000 + state_estimate_us + d.command_us + d.flight_controller_us);
  }
}

void expect_equal(const FlightRecord& a, const FlightRecord& b) {
  EXPECT_EQ(a.last.t_us, b.last.t_us);
  EXPECT_EQ(a.last.vehicle.p_W, b.last.vehicle.p_W);
  EXPECT_EQ(a.last.vehicle.q_W.coeffs(), b.last.vehicle.q_W.coeffs());
  EXPECT_EQ(a.last.vehicle.v_W, b.last.vehicle.v_W);
  EXPECT_EQ(a.last.vehicle.w_W, b.last.vehicle.w_W);
  EXPECT_EQ(a.last.objects[0].p_W, b.last.objects[0].p_W);
  EXPECT_EQ(a.verdict.nearest.clearance_m, b.verdict.nearest.clearance_m);
  EXPECT_EQ(a.verdict.nearest.closest_us, b.verdict.nearest.closest_us);
  EXPECT_EQ(a.first_command_us, b.first_command_us);
}

TEST(Loop, AFlightIsTheSameBitForBitWhateverWasFlownBefore) {
  const Scenario s = thrown_from_everywhere(kHover, "!uniform [-0.2, 0.2]");
  const FlightRecord first = fly_as("oracle", s, plan_throw(s, 2));
  const FlightRecord again = fly_as("oracle", s, plan_throw(s, 2));
  expect_equal(first, again);
  for (const int k : {5, 0}) fly_as("none", s, plan_throw(s, k));
  expect_equal(first, fly_as("oracle", s, plan_throw(s, 2)));
}

// The first reading of each sensor.
class FirstReadings : public FlightObserver {
 public:
  void on_imu(const ImuReading& reading) override {
    if (imu.t_us == 0) imu = reading;
  }
  void on_state(const StateReading& reading) override {
    if (state.t_us == 0) state = reading;
  }
  ImuReading imu;
  StateReading state;
};

TEST(Loop, EveryThrowAndEverySeedHasItsOwnNoise) {
  Scenario s = scenario(std::string(kHover) + "duration_s: 0.1\npilot: none\n");
  FirstReadings first, other_throw, other_seed;
  fly(s, plan_throw(s, 0), &first);
  fly(s, plan_throw(s, 1), &other_throw);
  s.seed = 2;
  fly(s, plan_throw(s, 0), &other_seed);
  for (const FirstReadings* other : {&other_throw, &other_seed}) {
    // More than the little that the vehicle's own motion differs so soon.
    EXPECT_GT((first.imu.f_B_mps2 - other->imu.f_B_mps2).norm(), 0.01);
    EXPECT_GT((first.state.p_W - other->state.p_W).norm(), 1e-4);
  }
}

// The mean rate that the pilot's gyroscope reads about z.
class MeanYawRate : public FlightObserver {
 public:
  void on_imu(const ImuReading& reading) override {
    sum_radps_ += reading.w_B_radps.z();
    ++count_;
  }
  double radps() const { return sum_radps_ / count_; }

 private:
  double sum_radps_ = 0;
  int count_ = 0;
};

// The bias of the flight controller's gyroscope turns the vehicle until the heading's error makes
// up for it, and is not what the pilot's reads.
TEST(Loop, TheFlightControllersGyroscopeIsNotThePilots) {
  Scenario s = scenario("duration_s: 2\npilot: none\nmission: {start_m: [-1, 0, 2]}\n");
  s.sensors.imu.gyro_initial_bias_radps = 0.2;
  constexpr int kThrows = 4;
  double square = 0;
  for (int k = 0; k < kThrows; ++k) {
    MeanYawRate pilots;
    const FlightRecord record = fly(s, plan_throw(s, k), &pilots);
    const Vector3d x_W = record.last.vehicle.q_W * Vector3d::UnitX();
    const double bias_radps = -s.controller.attitude_gain_z_1ps * std::atan2(x_W.y(), x_W.x());
    square += std::pow(pilots.radps() - bias_radps, 2) / kThrows;
  }
  EXPECT_GT(std::sqrt(square), 0.1);
}

TEST(Loop, AnObserverChangesNothing) {
  const Scenario s = thrown_from_everywhere(kHover, "0.1");
  Diary diary;
  const FlightPlan plan = plan_throw(s, 3);
  expect_equal(fly_as("oracle", s, plan, &diary), fly_as("oracle", s, plan));
}

TEST(Loop, TheVehicleHoldsItsHoverDespiteNoise) {
  for (const int seed : {1, 2, 3}) {
    Scenario s = scenario(std::string(kHover) + "duration_s: 5\npilot: none\n");
    s.seed = static_cast<std::uint64_t>(seed);
    Diary diary;
    const FlightPlan plan = plan_throw(s, 0);
    EXPECT_TRUE(plan.launches.empty());
    const FlightRecord record = fly(s, plan, &diary);
    EXPECT_EQ(record.last.t_us, 5000000);
    double farthest_m = 0, fastest_mps = 0;
    for (const Snapshot& now : diary.snapshots()) {
      farthest_m = std::max(farthest_m, (now.vehicle.p_W - s.mission.start_m).norm());
      fastest_mps = std::max(fastest_mps, now.vehicle.v_W.norm());
    }
    EXPECT_LT(farthest_m, 0.05);
    EXPECT_GT(fastest_mps, 1e-4);  // the noise is on
  }
}

TEST(Loop, TheVehicleKeepsItsHeading) {
  const Scenario s =
      scenario("mission: {start_m: [0, 0, 2], heading_deg: 120}\nduration_s: 2\npilot: none\n");
  const FlightRecord record = fly(s, plan_throw(s, 0));
  const Vector3d x_W = record.last.vehicle.q_W * Vector3d::UnitX();
  EXPECT_NEAR(std::atan2(x_W.y(), x_W.x()) * 180 / M_PI, 120, 3);
}

TEST(Loop, GoalFlightCruisesAtItsSpeedAndStopsAtTheGoal) {
  const Scenario s = scenario(std::string(kGoalFlight) + "duration_s: 11\npilot: none\n");
  Diary diary;
  const FlightRecord record = fly(s, plan_throw(s, 0), &diary);
  EXPECT_LT((record.last.vehicle.p_W - *s.mission.goal_m).norm(), 0.1);
  EXPECT_LT(record.last.vehicle.v_W.norm(), 0.1);
  EXPECT_FALSE(record.verdict.crashed);
  const Vector3d course_W = (*s.mission.goal_m - s.mission.start_m).normalized();
  for (TimeUs t_us = 2000000; t_us <= 5000000; t_us += 100000) {
    const Vector3d v_W = diary.at(t_us).vehicle.v_W;
    EXPECT_NEAR(v_W.dot(course_W), 1.5, 0.1) << "at " << t_us << " us";
    EXPECT_LT((v_W - v_W.dot(course_W) * course_W).norm(), 0.1) << "at " << t_us << " us";
  }
}

TEST(Loop, DivergedPhysicsEndTheFlightWithTheReason) {
  const Scenario s = thrown_from_everywhere(kHover, "0");
  FlightPlan plan = plan_throw(s, 0);
  plan.launches[0].state.v_W.x() = 1e12;
  EXPECT_THROW(fly_as("none", s, plan), SimulationError);
}

}  // namespace
}  // namespace dodgesim
