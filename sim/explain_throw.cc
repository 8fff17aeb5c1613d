#include "sim/explain_throw.h"

#include <algorithm>
#include <span>

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
    return reach_m(hull, q_W.conjugate() * direction_W);
  };
  return contact;
}

using Commands = std::span<const Testimony::Command>;

// The commands from the first evasive one on.
Commands answer(const Testimony& testimony, TimeUs from_us) {
  const Commands all = testimony.commands;
  const auto first = std::find_if(all.begin(), all.end(), [&](const Testimony::Command& command) {
    return command.evading && command.t_us >= from_us;
  });
  return {first, all.end()};
}

// Those before the contact, but at least the first.
Commands before(TimeUs contact_us, Commands commands) {
  const auto end = std::find_if(commands.begin() + 1, commands.end(),
                                [&](const auto& command) { return command.t_us >= contact_us; });
  return {commands.begin(), end};
}

// See CollisionEvidence::command_W.
Vector3d mean_evasion(Commands commands) {
  Vector3d sum_W = Vector3d::Zero();
  int count = 0;
  for (const Testimony::Command& command : commands) {
    if (!command.evading) continue;
    sum_W += command.v_W;
    ++count;
  }
  return sum_W / count - commands.front().vehicle_v_W;
}

// See CollisionEvidence::commanded_path_W.
Vector3d path(Commands commands, TimeUs contact_us) {
  Vector3d path_W = Vector3d::Zero();
  for (std::size_t i = 0; i < commands.size() && commands[i].t_us < contact_us; ++i) {
    const TimeUs next_us = i + 1 < commands.size() ? commands[i + 1].t_us : contact_us;
    path_W += seconds(std::min(next_us, contact_us) - commands[i].t_us) *
              (commands[i].v_W - commands.front().vehicle_v_W);
  }
  return path_W;
}

// The pilot's answer to the detection of an object.
void add_answer(const Testimony& testimony, const Testimony::Object& object, bool perceives,
                CollisionEvidence& evidence) {
  TimeUs from_us = 0;
  if (perceives) {
    if (object.detections.empty()) return;
    from_us = object.detections.front().output_us;
  }
  Commands commands = answer(testimony, from_us);
  if (commands.empty()) return;
  evidence.command_us = commands.front().t_us;
  if (evidence.undisturbed) commands = before(evidence.undisturbed->contact_us, commands);
  evidence.command_W = mean_evasion(commands);
  if (evidence.undisturbed) {
    evidence.commanded_path_W = path(commands, evidence.undisturbed->contact_us);
  }
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
