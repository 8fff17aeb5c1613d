#include "sim/paper/avoidance_bound.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "sim/base/error.h"
#include "sim/base/gravity.h"
#include "sim/base/time.h"
#include "sim/flight/setup.h"
#include "sim/outcome/agility.h"
#include "sim/world/referee.h"
#include "sim/world/world.h"

namespace dodgesim {

namespace {

constexpr double kMeanBallRadiusM = 0.1;

// The scenario's vehicle.
struct Body {
  Agility agility;
  std::vector<Convex> hull;
  double camera_m = 0;  // how far the first camera is ahead of its centre
};

Body body_of(const Scenario& scenario) {
  const World world(world_spec(scenario, {}));
  return {agility_of(world.vehicle(), scenario.motors), Referee(world).hull(),
          world.vehicle().X_BC.at(0).translation().x()};
}

// A ball that comes along -x at the middle of the vehicle, at the instant at which it touches it.
Encounter head_on(const std::vector<Convex>& hull, double speed_mps) {
  const Convex ball = Convex::sphere(Eigen::Vector3d::Zero(), kMeanBallRadiusM);
  constexpr double kTouchingM = 1e-6;
  Eigen::Isometry3d X_BO = Eigen::Isometry3d::Identity();
  X_BO.translation().x() = reach_m(hull, Eigen::Vector3d::UnitX()) + kMeanBallRadiusM;
  const double behind_m = reach_m(hull, -Eigen::Vector3d::UnitX()) + kMeanBallRadiusM;
  double gap_m = 0;
  do {
    gap_m = convex_gap_m(hull, {ball}, X_BO);
    X_BO.translation().x() -= gap_m;
    if (X_BO.translation().x() < -behind_m) {
      throw ScenarioError("A ball of 20 cm flies through the middle of the vehicle's hull: there " +
                          std::string("is no bound of what it can dodge."));
    }
  } while (gap_m > kTouchingM);
  Encounter encounter;
  encounter.hull = hull;
  encounter.shape = {ball};
  encounter.object.p_W = X_BO.translation();
  encounter.object.v_W.x() = -speed_mps;
  return encounter;
}

// From an event's stamp to the start of the first cycle that has it, in the mean over all stamps.
double mean_wait_s(const DelaySpec& delays) {
  const TimeUs period_us = delays.period_us();
  const TimeUs cycles = delays.packet_us / std::gcd<TimeUs>(delays.packet_us, period_us);
  double sum_us2 = 0;  // over the stamps until packets and cycles stand to each other as before
  for (TimeUs start_us = period_us; start_us <= cycles * period_us; start_us += period_us) {
    const auto first_us = static_cast<double>(delays.newest_packet_end_us(start_us - period_us));
    const auto last_us = static_cast<double>(delays.newest_packet_end_us(start_us));
    sum_us2 += (last_us - first_us) * (static_cast<double>(start_us) - 0.5 * (first_us + last_us));
  }
  return 1e-6 * sum_us2 / static_cast<double>(cycles * period_us);
}

}  // namespace

double AvoidanceBound::greatest_speed_mps(double latency_s) const {
  constexpr double kPrecisionMps = 1e-3;
  double low = kPrecisionMps, high = 100;
  while (high - low > kPrecisionMps) {
    const double middle = 0.5 * (low + high);
    (greatest_latency_s(middle) >= latency_s ? low : high) = middle;
  }
  return low;
}

double point_avoidance_s(double distance_m, double acceleration_mps2) {
  return std::sqrt(2 * distance_m / acceleration_mps2);
}

AvoidanceBound point_bound(const Scenario& scenario, double range_m) {
  const Body body = body_of(scenario);
  const double sideways_m = reach_m(body.hull, Eigen::Vector3d::UnitY()) + kMeanBallRadiusM;
  const double sideways_mps2 =
      std::sqrt(std::pow(body.agility.max_thrust_mps2, 2) - std::pow(kGravityMps2, 2));
  const double escape_s = point_avoidance_s(sideways_m, sideways_mps2);
  return {range_m, [escape_s](double) { return escape_s; }};
}

AvoidanceBound rotors_bound(const Scenario& scenario, double range_m) {
  return {range_m, [body = body_of(scenario)](double speed_mps) {
            const Encounter encounter = head_on(body.hull, speed_mps);
            const double not_flown_m = encounter.object.p_W.x() - body.camera_m;
            return not_flown_m / speed_mps + least_time_to_escape_s(body.agility, encounter)
                                                 .value_or(std::numeric_limits<double>::infinity());
          }};
}

double latency_without_pilot_s(const Scenario& scenario) {
  const DelaySpec& delays = scenario.delays;
  return seconds(scenario.sensors.events.latency_us + delays.command_us +
                 delays.flight_controller_us) +
         mean_wait_s(delays);
}

}  // namespace dodgesim
