#include "sim/flight/plan.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/config/resolve_throw.h"
#include "sim/flight/setup.h"
#include "sim/loop.h"
#include "sim/world/ray.h"

namespace dodgesim {

namespace {

TimeUs microseconds(double seconds) { return std::llround(seconds * 1e6); }

TimeUs round_to_tick(TimeUs t_us) { return (t_us + kTickUs / 2) / kTickUs * kTickUs; }

// Where the vehicle's centre is at t_us if nobody throws and nobody dodges.
BodyState undisturbed_vehicle(const Scenario& scenario, int throw_index, TimeUs t_us,
                              FlightObserver* observer) {
  FlightPlan quiet;
  quiet.throw_index = throw_index;
  quiet.pilot = kNoPilot;
  quiet.end_us = t_us;
  return fly(scenario, quiet, observer).last.vehicle;
}

// A throw from behind a wall is a mistake of the scenario, not a miss.
void check_free_way(const World& world, const Eigen::Vector3d& vehicle_p_W,
                    const Eigen::Vector3d& launch_p_W) {
  const Eigen::Vector3d ray_W = launch_p_W - vehicle_p_W;
  const std::optional<RayHit> hit = obstruction_along(world, vehicle_p_W, ray_W);
  if (!hit || hit->distance >= 1) return;
  throw ScenarioError(formatted("The throw starts at (%g, %g, %g) m, behind the room's \"",
                                launch_p_W.x(), launch_p_W.y(), launch_p_W.z()) +
                      geom_name(world, hit->geom) +
                      "\" as seen from the vehicle: change throw.distance_m, throw.bearing_deg, "
                      "throw.launch_height_m or the mission.");
}

// How object i leaves the hand to meet the vehicle. Throws ScenarioError if it cannot.
BodyState launch_at(const BodyState& vehicle, const Throw& drawn, const World& world, int i) {
  const Eigen::Vector3d x_W = vehicle.q_W * Eigen::Vector3d::UnitX();
  BodyState launch = solve_throw(drawn, world.object(i), vehicle.p_W, std::atan2(x_W.y(), x_W.x()));
  check_free_way(world, vehicle.p_W, launch.p_W);
  return launch;
}

}  // namespace

FlightPlan plan_throw(const Scenario& scenario, int throw_index, FlightObserver* observer) {
  FlightPlan plan;
  plan.throw_index = throw_index;
  plan.pilot = scenario.pilot;
  if (!scenario.anyone_throws()) {
    plan.end_us = round_to_tick(microseconds(scenario.duration_s));
    return plan;
  }
  for (const Throw& drawn : resolve_throws(scenario, throw_index)) {
    plan.launches.push_back({drawn, {}});
  }
  const World world(world_spec(scenario, plan.launches));
  for (int i = 0; i < world.object_count(); ++i) {
    FlightPlan::Launch& launch = plan.launches[static_cast<std::size_t>(i)];
    const BodyState vehicle =
        undisturbed_vehicle(scenario, throw_index, launch.drawn.arrival_us(), observer);
    try {
      launch.state = launch_at(vehicle, launch.drawn, world, i);
    } catch (const ScenarioError& error) {
      if (world.object_count() == 1) throw;
      throw ScenarioError("Object " + std::to_string(i) + ": " + error.what());
    }
    plan.end_us = std::max(
        plan.end_us, round_to_tick(launch.drawn.arrival_us() + microseconds(scenario.after_s)));
  }
  return plan;
}

}  // namespace dodgesim
