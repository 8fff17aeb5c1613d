#include "sim/loop.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "sim/base/error.h"
#include "sim/config/pilot.h"
#include "sim/config/resolve_throw.h"
#include "sim/flight/explain_throw.h"
#include "sim/outcome/blank_result.h"
#include "sim/world/ray.h"

namespace dodgesim {

FlightRecord fly(const Scenario& scenario, const FlightPlan& plan, FlightObserver* observer,
                 FlightTiming* timing) {
  Flight flight(scenario, plan, observer);
  while (!flight.over()) {
    flight.move();
    flight.sense();
    flight.see();
    flight.decide();
    flight.control();
    flight.judge();
  }
  if (timing != nullptr) *timing = flight.timing();
  return flight.record();
}

namespace {

TimeUs microseconds(double seconds) { return std::llround(seconds * 1e6); }

TimeUs round_to_tick(TimeUs t_us) { return (t_us + kTickUs / 2) / kTickUs * kTickUs; }

// Where the vehicle's centre is at t_us if nobody throws and nobody dodges.
BodyState undisturbed_vehicle(const Scenario& scenario, int throw_index, TimeUs t_us) {
  FlightPlan quiet;
  quiet.throw_index = throw_index;
  quiet.pilot = kNoPilot;
  quiet.end_us = t_us;
  return fly(scenario, quiet).last.vehicle;
}

// A throw from behind a wall is a mistake of the scenario, not a miss.
void check_launch_in_sight(const World& world, const Eigen::Vector3d& vehicle_p_W,
                           const Eigen::Vector3d& launch_p_W) {
  const Eigen::Vector3d ray_W = launch_p_W - vehicle_p_W;
  const std::optional<RayHit> hit = room_along(world, vehicle_p_W, ray_W);
  if (!hit || hit->distance >= 1) return;
  std::ostringstream message;
  message << "The throw starts at (" << launch_p_W.x() << ", " << launch_p_W.y() << ", "
          << launch_p_W.z() << ") m, behind the room's \"" << geom_name(world, hit->geom)
          << "\" as seen from the vehicle: change throw.distance_m, throw.bearing_deg, "
             "throw.launch_height_m or the mission.";
  throw ScenarioError(message.str());
}

// How object i leaves the hand to meet the vehicle. Throws ScenarioError if it cannot.
BodyState launch_at(const BodyState& vehicle, const Throw& toss, const World& world, int i) {
  const Eigen::Vector3d x_W = vehicle.q_W * Eigen::Vector3d::UnitX();
  BodyState launch = solve_throw(toss, world.object(i), vehicle.p_W, std::atan2(x_W.y(), x_W.x()));
  check_launch_in_sight(world, vehicle.p_W, launch.p_W);
  return launch;
}

// To a flight's or an object's result.
template <class Result>
void copy_approach(const Approach& approach, Result& result) {
  result.hit = approach.hit;
  result.hit_us = approach.hit_us;
  result.closest_us = approach.closest_us;
  if (approach.closest_us) result.clearance_m = approach.clearance_m;
}

FlightResult summary(const FlightRecord& record, bool thrown) {
  FlightResult result;
  result.status = "ok";
  result.crashed = record.verdict.crashed;
  if (!thrown) return result;
  copy_approach(record.verdict.nearest, result);
  return result;
}

FlightResult failure(const std::exception& error) {
  FlightResult result;
  result.status = "error";
  result.error = error.what();
  return result;
}

// Flies one pilot; a failed simulation costs this flight only and is recorded with its reason.
FlightResult attempt(const Scenario& scenario, FlightPlan plan, const std::string& pilot,
                     FlightObserver* observer = nullptr, FlightRecord* record = nullptr,
                     FlightTiming* timing = nullptr) {
  plan.pilot = pilot;
  try {
    const FlightRecord flown = fly(scenario, plan, observer, timing);
    if (record != nullptr) *record = flown;
    return summary(flown, !plan.launches.empty());
  } catch (const SimulationError& error) {
    return failure(error);
  }
}

// What the referee says of an object; nothing if the flight failed.
Approach approach(const FlightRecord& record, int object) {
  const auto i = static_cast<std::size_t>(object);
  return i < record.verdict.objects.size() ? record.verdict.objects[i] : Approach{};
}

void copy_object(const FlightRecord& record, ObjectRow& row) {
  copy_approach(approach(record, row.object), row);
  const auto i = static_cast<std::size_t>(row.object);
  if (i >= record.detections.first_of_object.size()) return;
  const auto& first = record.detections.first_of_object[i];
  if (!first) return;
  row.first_detection_us = first->output_us;
  row.first_detection_distance_m = first->distance_m;
}

void copy_record(const FlightRecord& record, ThrowResult& result) {
  if (const auto& first = record.detections.first) {
    result.first_detection_us = first->output_us;
    result.first_detection_t_us = first->t_us;
    result.first_detection_distance_m = first->distance_m;
  }
  result.first_command_us = record.first_command_us;
  result.evaded = record.first_command_us.has_value();
  result.landing_us = record.landing_us;
  if (record.verdict.landed) result.landed_us = record.verdict.landed_us;
  result.detections = static_cast<int>(record.detections.rows.size());
  result.events = record.events;
  result.events_lost = record.events_lost;
  result.events_hash = record.events_hash;
  result.duration_us = record.last.t_us;
  result.detection_rows = record.detections.rows;
}

}  // namespace

FlightPlan plan_throw(const Scenario& scenario, int throw_index) {
  FlightPlan plan;
  plan.throw_index = throw_index;
  plan.pilot = scenario.pilot;
  if (!scenario.anyone_throws()) {
    plan.end_us = round_to_tick(microseconds(scenario.duration_s));
    return plan;
  }
  for (const Throw& toss : resolve_throws(scenario, throw_index)) {
    plan.launches.push_back({toss, {}});
  }
  World world(world_spec(scenario, plan.launches));
  world.reset(scenario.mission.start_m, 0, Eigen::Vector3d::Zero());
  for (int i = 0; i < world.object_count(); ++i) {
    FlightPlan::Launch& launch = plan.launches[static_cast<std::size_t>(i)];
    const BodyState vehicle = undisturbed_vehicle(scenario, throw_index, launch.toss.arrival_us());
    try {
      launch.state = launch_at(vehicle, launch.toss, world, i);
    } catch (const ScenarioError& error) {
      if (world.object_count() == 1) throw;
      throw ScenarioError("Object " + std::to_string(i) + ": " + error.what());
    }
    plan.end_us = std::max(
        plan.end_us, round_to_tick(launch.toss.arrival_us() + microseconds(scenario.after_s)));
  }
  return plan;
}

ThrowResult fly_throw(const Scenario& campaign, int index, FlightObserver* observer) {
  const ThrowCase thrown = case_of(campaign, index);
  const Scenario& scenario = thrown.scenario;
  ThrowResult result = blank_result(thrown);
  FlightPlan plan;
  try {
    plan = plan_throw(scenario, thrown.stream);
  } catch (const std::runtime_error& error) {  // also a ScenarioError: one draw may be impossible
    result.flown = failure(error);
    return result;
  }
  FlightRecord record;
  FlightTiming timing;
  result.flown = attempt(scenario, plan, scenario.pilot, observer, &record, &timing);
  FlightRecord none = scenario.pilot == kNoPilot ? record : FlightRecord{};
  if (!plan.launches.empty()) {
    const auto also = [&](const std::string& pilot, FlightRecord* seen) {
      if (pilot == scenario.pilot) return result.flown;
      return attempt(scenario, plan, pilot, nullptr, seen);
    };
    result.none = also(kNoPilot, &none);
    if (scenario.fly_oracle) result.oracle = also(kOraclePilot, nullptr);
    for (ObjectRow& row : result.object_rows) {
      row.none_hit = approach(none, row.object).hit;
      row.none_after_room = approach(none, row.object).after_room;
      result.none_after_room |= row.none_after_room;
    }
  }
  for (ObjectRow& row : result.object_rows) copy_object(record, row);
  for (DetectionRow& row : record.detections.rows) row.throw_index = index;
  copy_record(record, result);
  if (result.flown.ok()) {
    explain_throw(plan, result.none.ok() ? &none : nullptr, record, result);
    result.trajectory = to_bytes(record.testimony.trajectory);
  }
  result.wall_s = timing.total_s;
  return result;
}

}  // namespace dodgesim
