#include "sim/flight/fly_throw.h"

#include <algorithm>
#include <string>
#include <utility>

#include "sim/base/error.h"
#include "sim/config/expand.h"
#include "sim/config/pilot.h"
#include "sim/flight/explain_throw.h"
#include "sim/loop.h"
#include "sim/outcome/blank_result.h"

namespace dodgesim {

namespace {

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

struct Attempt {
  FlightResult result;
  FlightRecord record;  // empty if the flight failed
};

// Flies one pilot; a failed simulation costs this flight only and is recorded with its reason.
Attempt attempt(const Scenario& scenario, FlightPlan plan, const std::string& pilot,
                FlightObserver* observer = nullptr) {
  plan.pilot = pilot;
  try {
    FlightRecord record = fly(scenario, plan, observer);
    const FlightResult result = summary(record, !plan.launches.empty());
    return {result, std::move(record)};
  } catch (const SimulationError& error) {
    return {failure(error), {}};
  }
}

// What the referee says of an object; nothing if the flight failed.
Approach approach(const FlightRecord& record, int object) {
  const auto i = static_cast<std::size_t>(object);
  return i < record.verdict.objects.size() ? record.verdict.objects[i] : Approach{};
}

void copy_object(const FlightRecord& record, const FlightRecord& none, ObjectRow& row) {
  copy_approach(approach(record, row.object), row);
  const Approach undisturbed = approach(none, row.object);
  row.none_hit = undisturbed.hit;
  row.none_after_room = undisturbed.after_room;
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
  for (DetectionRow& row : result.detection_rows) row.throw_index = result.index;
  result.wall_s = record.timing.total_s;
}

}  // namespace

ThrowResult fly_throw(const Scenario& campaign, int index, FlightObserver* observer) {
  const ThrowCase thrown = case_of(campaign, index);
  const Scenario& scenario = thrown.scenario;
  ThrowResult result = blank_result(thrown);
  FlightPlan plan;
  try {
    plan = plan_throw(scenario, thrown.stream);
  } catch (const SimulationError& error) {
    result.flown = failure(error);
    return result;
  } catch (const ScenarioError& error) {  // one draw may be impossible; not so MemoryError, IoError
    result.flown = failure(error);
    return result;
  }
  const Attempt own = attempt(scenario, plan, scenario.pilot, observer);
  const auto attempt_also = [&](const std::string& pilot) {
    return pilot == scenario.pilot ? own : attempt(scenario, plan, pilot);
  };
  const bool objects = !plan.launches.empty();
  const Attempt none = objects ? attempt_also(kNoPilot) : Attempt{};
  const Attempt oracle = objects && scenario.fly_oracle ? attempt_also(kOraclePilot) : Attempt{};
  result.flown = own.result;
  result.none = none.result;
  result.oracle = oracle.result;
  copy_record(own.record, result);
  for (ObjectRow& row : result.object_rows) copy_object(own.record, none.record, row);
  result.none_after_room = std::ranges::any_of(result.object_rows, &ObjectRow::none_after_room);
  if (own.result.ok()) {
    explain_throw(plan, none.result.ok() ? &none.record : nullptr, own.record, result);
    const Trajectory& trajectory = own.record.log.trajectory;  // empty if it ended before
    if (!trajectory.samples.empty()) result.trajectory = to_bytes(trajectory);
  }
  return result;
}

}  // namespace dodgesim
