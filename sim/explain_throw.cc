#include "sim/explain_throw.h"

#include <algorithm>

namespace dodgesim {

namespace {

using Eigen::Vector3d;

// The contact of the flight that nobody evaded in, if there was one.
std::optional<Encounter> encounter(const FlightRecord& none) {
  const Approach& nearest = none.verdict.nearest;
  if (!nearest.hit) return std::nullopt;
  const auto i = static_cast<std::size_t>(none.verdict.nearest_object);
  const BodyState &vehicle = none.last.vehicle, &object = none.last.objects[i];
  Encounter contact;
  contact.contact_us = nearest.hit_us;
  contact.offset_W = object.p_W - vehicle.p_W;
  contact.velocity_W = object.v_W - vehicle.v_W;
  contact.object_radius_m = 0.5 * none.testimony.trajectory.sizes_m[i];
  contact.hull_reach_m = [hull = none.hull, q_W = vehicle.q_W](const Vector3d& direction_W) {
    const Vector3d direction_B = q_W.conjugate() * direction_W;
    double reach_m = 0;
    for (const Convex& part : hull) {
      reach_m = std::max(reach_m, part.reach_m(direction_B));
    }
    return reach_m;
  };
  return contact;
}

// The pilot's answer to the detection of an object: the evasive commands from then on.
void add_answer(const Testimony& testimony, const Testimony::Object& object, bool perceives,
                CollisionEvidence& evidence) {
  TimeUs from_us = 0;
  if (perceives) {
    if (object.detections.empty()) return;
    from_us = object.detections.front().output_us;
  }
  Vector3d sum_W = Vector3d::Zero(), start_W = Vector3d::Zero();
  int count = 0;
  for (const Testimony::Command& command : testimony.commands) {
    if (command.t_us < from_us) continue;
    if (count++ == 0) {
      evidence.command_us = command.t_us;
      start_W = command.vehicle_v_W;
    }
    sum_W += command.v_W;
  }
  if (count == 0) return;
  evidence.command_W = sum_W / count - start_W;
  for (const Testimony::Object::Detection& detection : object.detections) {
    if (detection.output_us <= *evidence.command_us) evidence.position_error_W = detection.error_W;
  }
}

CollisionEvidence evidence_of(const FlightPlan& plan, const FlightRecord* none,
                              const FlightRecord& flown) {
  CollisionEvidence evidence;
  evidence.hit = flown.verdict.nearest.hit;
  evidence.landing = flown.landing_us.has_value();
  evidence.evaded = flown.first_command_us.has_value();
  evidence.perceives = perceives(plan.pilot);
  if (!evidence.hit) return evidence;
  const auto hitter = static_cast<std::size_t>(flown.verdict.nearest_object);
  const Testimony& testimony = flown.testimony;
  const Testimony::Object& object = testimony.objects[hitter];
  evidence.in_view = object.in_view_us.has_value();
  evidence.detected = !object.detections.empty();
  for (std::size_t i = 0; i < testimony.objects.size(); ++i) {
    const auto& other = testimony.objects[i].detections;
    if (i == hitter || other.empty()) continue;
    if (!evidence.detected || other.front().output_us < object.detections.front().output_us) {
      evidence.another_detected_before = true;
    }
  }
  // Of a later object nobody knows how it would have met a vehicle that stayed.
  if (none != nullptr && none->verdict.nearest_object == flown.verdict.nearest_object) {
    evidence.undisturbed = encounter(*none);
  }
  add_answer(testimony, object, evidence.perceives, evidence);
  return evidence;
}

}  // namespace

void explain_throw(const FlightPlan& plan, const FlightRecord* none, const FlightRecord& flown,
                   ThrowResult& result) {
  for (const Testimony::Object& object : flown.testimony.objects) {
    if (!object.in_view_us) continue;
    result.first_in_view_us =
        std::min(*object.in_view_us, result.first_in_view_us.value_or(*object.in_view_us));
  }
  const std::optional<TimeUs> contact_us =
      result.none.hit_us ? result.none.hit_us : result.none.closest_us;
  if (contact_us && result.first_detection_us) {
    result.time_to_contact_us = *contact_us - *result.first_detection_us;
  }
  result.false_alarm =
      result.first_command_us && (plan.launches.empty() || perceives(plan.pilot)) &&
      (!result.first_detection_us || *result.first_command_us < *result.first_detection_us);
  if (plan.pilot == "none" || !(result.flown.hit || result.flown.crashed)) return;
  const CollisionVerdict verdict = judge_collision(flown.agility, evidence_of(plan, none, flown));
  result.cause = to_text(verdict.cause);
  result.escape_left_s = verdict.left_s;
  result.escape_needed_s = verdict.needed_s;
}

}  // namespace dodgesim
