#include "sim/paper/avoidance_bound.h"

#include <cmath>

#include "sim/base/gravity.h"
#include "sim/base/time.h"
#include "sim/campaign/collision_cause.h"
#include "sim/flight.h"
#include "sim/world/referee.h"

namespace dodgesim {

double point_avoidance_s(double distance_m, double acceleration_mps2) {
  return std::sqrt(2 * distance_m / acceleration_mps2);
}

AvoidanceTimes avoidance_times(const Scenario& scenario, double ball_radius_m) {
  const World world(world_spec(scenario, {}));
  const Referee referee(world);
  const Agility agility = agility_of(world.vehicle(), scenario.motors);
  Encounter encounter;
  encounter.velocity_W = -Eigen::Vector3d::UnitX();
  encounter.object_radius_m = ball_radius_m;
  encounter.hull_reach_m = [&referee](const Eigen::Vector3d& direction) {
    return reach_m(referee.hull(), direction);
  };
  const double sideways_m = encounter.hull_reach_m(Eigen::Vector3d::UnitY()) + ball_radius_m;
  const double sideways_mps2 =
      std::sqrt(std::pow(agility.max_thrust_mps2, 2) - std::pow(kGravityMps2, 2));
  return {point_avoidance_s(sideways_m, sideways_mps2), least_time_to_escape_s(agility, encounter)};
}

double latency_without_pilot_s(const Scenario& scenario) {
  const DelaySpec& delays = scenario.delays;
  return seconds(scenario.sensors.events.latency_us + delays.transport_us + delays.command_us +
                 delays.flight_controller_us) +
         0.5 * seconds(delays.cycle_us);
}

}  // namespace dodgesim
