#include "sim/paper/avoidance_bound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/flight/setup.h"
#include "sim/outcome/agility.h"
#include "sim/world/referee.h"
#include "tests/sim/paper/synthetic_passage.h"

namespace dodgesim {
namespace {

// A point that starts `latency_s` after the object was seen at `range_m`, in steps of 10 us: has it
// moved by `distance_m` when the object arrives?
bool point_escapes(double range_m, double speed_mps, double latency_s, double distance_m,
                   double acceleration_mps2) {
  constexpr double kStepS = 1e-5;
  double moved_m = 0, moving_mps = 0;
  for (double t_s = latency_s; speed_mps * t_s < range_m; t_s += kStepS) {
    moving_mps += acceleration_mps2 * kStepS;
    moved_m += moving_mps * kStepS;
  }
  return moved_m >= distance_m;
}

TEST(AvoidanceBound, DividesWhatAPointEscapesFromWhatItDoesNot) {
  constexpr double kDistanceM = 0.27, kAccelerationMps2 = 20;
  const double escape_s = point_avoidance_s(kDistanceM, kAccelerationMps2);
  const AvoidanceBound bound{1.5, [=](double) { return escape_s; }};
  for (const double speed_mps : {2.0, 4.0, 6.0}) {
    const double latency_s = bound.greatest_latency_s(speed_mps);
    ASSERT_GT(latency_s, 0);
    EXPECT_TRUE(point_escapes(1.5, speed_mps, latency_s - 1e-3, kDistanceM, kAccelerationMps2));
    EXPECT_FALSE(point_escapes(1.5, speed_mps, latency_s + 1e-3, kDistanceM, kAccelerationMps2));
    EXPECT_NEAR(bound.greatest_speed_mps(latency_s), speed_mps, 1.1e-3);
  }
  EXPECT_LT(bound.greatest_latency_s(15), 0);
}

TEST(AvoidanceBound, OfAPointTakesTheHullAndTheThrust) {
  const AvoidanceBound bound = point_bound(paper_scenario("throw: {}\n"), 1.5);
  // 4 rotors of 9.5 N lift 1 kg: 36.7 m/s^2 to the side. The hull is 0.34 m wide.
  EXPECT_NEAR(bound.escape_s(6), std::sqrt(2 * (0.17 + 0.1) / 36.7), 0.003);
  EXPECT_EQ(bound.escape_s(3), bound.escape_s(6));
}

TEST(AvoidanceBound, OfTheRotorsTakesTheirLagAndTheBallsWayToTheHull) {
  const Scenario scenario = paper_scenario("throw: {}\n");
  const AvoidanceBound bound = rotors_bound(scenario, 1.5);
  // The ball touches the hull 0.27 m before its middle, 0.15 m ahead of the camera.
  const World world(world_spec(scenario, {}));
  Encounter encounter;
  encounter.object.p_W.x() = 0.27;
  encounter.object.v_W.x() = -6;
  encounter.hull = Referee(world).hull();
  encounter.shape = {Convex::sphere(Eigen::Vector3d::Zero(), 0.1)};
  const Agility agility{38, 404, 0.04, 0.001};
  EXPECT_NEAR(bound.escape_s(6), 0.15 / 6 + *least_time_to_escape_s(agility, encounter), 0.005);
  EXPECT_GT(bound.escape_s(12), bound.escape_s(6) - 0.15 / 12);
  const double speed_mps = bound.greatest_speed_mps(0.02);
  EXPECT_NEAR(bound.greatest_latency_s(speed_mps), 0.02, 0.002);
}

// The mean over light at each microsecond, that goes as an event's packet does.
TEST(AvoidanceBound, TakesTheMeanLatencyOfTheChain) {
  struct Delays {
    int packet_us, transport_us, cycle_us, compute_us;
  };
  for (const Delays& d : {Delays{1000, 1000, 4000, 3500}, Delays{1000, 650, 4000, 3500},
                          Delays{700, 0, 4000, 4100}, Delays{10000, 1200, 4000, 2000}}) {
    Scenario scenario = paper_scenario("throw: {}\n");
    scenario.delays.packet_us = d.packet_us;
    scenario.delays.transport_us = d.transport_us;
    scenario.delays.cycle_us = d.cycle_us;
    scenario.delays.compute_us = d.compute_us;
    const int period_us = d.compute_us > d.cycle_us ? 4250 : d.cycle_us;  // in whole ticks
    const TimeUs lights = 40 * period_us;
    double sum_s = 0;
    for (TimeUs light_us = 1; light_us <= lights; ++light_us) {
      const TimeUs stamp_us = light_us + scenario.sensors.events.latency_us;
      TimeUs arrival_us = stamp_us + d.transport_us;
      if (stamp_us % d.packet_us != 0) arrival_us += d.packet_us - stamp_us % d.packet_us;
      TimeUs cycle_us = arrival_us;
      if (arrival_us % period_us != 0) cycle_us += period_us - arrival_us % period_us;
      sum_s += seconds(cycle_us - light_us);
    }
    const double command_s =
        seconds(scenario.delays.command_us) + seconds(scenario.delays.flight_controller_us);
    EXPECT_NEAR(latency_without_pilot_s(scenario), sum_s / static_cast<double>(lights) + command_s,
                1e-6)
        << d.packet_us << " " << d.cycle_us;
  }
}

}  // namespace
}  // namespace dodgesim
