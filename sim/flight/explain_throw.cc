#include "sim/flight/explain_throw.h"

#include <algorithm>
#include <span>

#include "sim/config/pilot.h"

namespace dodgesim {

namespace {

using Eigen::Vector3d;

// The contact of the flight in which nobody evaded.
Encounter encounter(const FlightRecord& none) {
  const auto i = static_cast<std::size_t>(none.verdict.nearest_object);
  Encounter contact;
  contact.contact_us = none.verdict.nearest.hit_us.value();
  contact.vehicle = none.last.vehicle;
  contact.object = none.last.objects[i];
  contact.hull = none.hull;
  contact.shape = none.shapes[i];
  return contact;
}

using Commands = std::span<const FlightLog::Command>;

// The commands from the first evasive one at from_us or later on.
Commands answer(const FlightLog& log, TimeUs from_us) {
  const Commands all = log.commands;
  const auto first = std::ranges::find_if(all, [&](const FlightLog::Command& command) {
    return command.evading && command.t_us >= from_us;
  });
  return {first, all.end()};
}

Commands before(TimeUs contact_us, Commands commands) {
  const auto end = std::ranges::find_if(
      commands, [&](const auto& command) { return command.t_us >= contact_us; });
  return {commands.begin(), end};
}

Vector3d mean_evasion_W(Commands commands) {
  Vector3d sum_W = Vector3d::Zero();
  int count = 0;
  for (const FlightLog::Command& command : commands) {
    if (!command.evading) continue;
    sum_W += command.v_W;
    ++count;
  }
  return sum_W / count;
}

// Of commands before the contact, the first of them evasive.
CommandedWay commanded_way(Commands commands, TimeUs contact_us) {
  const Vector3d& vehicle_v_W = commands.front().vehicle_v_W;
  CommandedWay way;
  way.mean_W = mean_evasion_W(commands) - vehicle_v_W;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const TimeUs next_us = i + 1 < commands.size() ? commands[i + 1].t_us : contact_us;
    way.path_W += seconds(next_us - commands[i].t_us) * (commands[i].v_W - vehicle_v_W);
  }
  way.last_W = commands.back().v_W - vehicle_v_W;
  return way;
}

// See CollisionEvidence::turn.
std::optional<CollisionEvidence::Turn> turn(Commands commands, const Encounter& undisturbed) {
  const auto across_W = [&](const FlightLog::Command& command) {
    return undisturbed.across_flight(command.v_W - commands.front().vehicle_v_W);
  };
  const Vector3d first_W = across_W(commands.front());
  const auto back = std::ranges::find_if(commands, [&](const FlightLog::Command& command) {
    return command.evading && across_W(command).dot(first_W) < 0;
  });
  if (back == commands.end()) return std::nullopt;
  return CollisionEvidence::Turn{back->t_us,
                                 commanded_way({commands.begin(), back}, undisturbed.contact_us)};
}

// The pilot's answer to an object that it knows of. Commands arrive command_delay_us after their
// output.
void add_answer(const FlightLog& log, const FlightLog::Object& object, TimeUs command_delay_us,
                CollisionEvidence& evidence) {
  if (!evidence.earliest_command_us) return;
  Commands commands = answer(log, *evidence.earliest_command_us);
  if (commands.empty()) return;
  evidence.command_us = commands.front().t_us;
  if (!evidence.undisturbed) return;
  commands = before(evidence.undisturbed->contact_us, commands);
  if (commands.empty()) return;
  evidence.commanded = commanded_way(commands, evidence.undisturbed->contact_us);
  evidence.turn = turn(commands, *evidence.undisturbed);
  for (const FlightLog::Object::Detection& detection : object.detections) {
    if (detection.output_us + command_delay_us <= *evidence.command_us) {
      evidence.position_error_W = detection.error_W;
    }
  }
}

CollisionEvidence evidence_of(const FlightPlan& plan, const FlightRecord* none,
                              const FlightRecord& flown) {
  CollisionEvidence evidence;
  evidence.hit = flown.verdict.nearest.hit;
  evidence.landing = flown.landing_us.has_value();
  evidence.evaded = flown.first_command_us.has_value();
  evidence.perceives = perceives(plan.pilot);
  const bool would_hit = none != nullptr && none->verdict.nearest.hit;
  if (!evidence.hit && !would_hit) return evidence;
  const int hitter = (evidence.hit ? flown : *none).verdict.nearest_object;
  const FlightLog& log = flown.log;
  const FlightLog::Object& object = log.objects[static_cast<std::size_t>(hitter)];
  evidence.in_view = object.in_view_us.has_value();
  evidence.in_view_near = object.in_view_near;
  if (object.known_us) evidence.earliest_command_us = *object.known_us + flown.command_delay_us;
  evidence.another_known_before = std::ranges::any_of(log.objects, [&](const auto& other) {
    return other.known_us && (!object.known_us || *other.known_us < *object.known_us);
  });
  // Of a later object nobody knows how it would have met a vehicle that stayed.
  const bool same = would_hit && none->verdict.nearest_object == hitter;
  if (same) evidence.undisturbed = encounter(*none);
  evidence.another_would_hit = would_hit && !same;
  evidence.rebound = evidence.hit && none != nullptr && flown.verdict.nearest.after_room &&
                     !(same && none->verdict.nearest.after_room);
  add_answer(log, object, flown.command_delay_us, evidence);
  return evidence;
}

// When the object that was detected first came into view; if none was, any.
std::optional<TimeUs> first_in_view_us(const FlightRecord& flown) {
  const std::vector<FlightLog::Object>& objects = flown.log.objects;
  const std::optional<DetectionLog::First>& detected = flown.detections.first;
  if (detected) return objects[static_cast<std::size_t>(detected->object)].in_view_us;
  std::optional<TimeUs> first_us;
  for (const FlightLog::Object& object : objects) {
    if (!object.in_view_us) continue;
    first_us = std::min(*object.in_view_us, first_us.value_or(*object.in_view_us));
  }
  return first_us;
}

}  // namespace

void explain_throw(const FlightPlan& plan, const FlightRecord* none, const FlightRecord& flown,
                   ThrowResult& result) {
  const std::optional<DetectionLog::First>& detected = flown.detections.first;
  result.first_in_view_us = first_in_view_us(flown);
  const std::optional<TimeUs> contact_us =
      result.none.hit_us ? result.none.hit_us : result.none.closest_us;
  if (contact_us && none && detected && none->verdict.nearest_object == detected->object) {
    result.time_to_contact_us = *contact_us - detected->output_us;
  }
  result.false_alarm =
      result.first_command_us && (plan.launches.empty() || perceives(plan.pilot)) &&
      (!detected || *result.first_command_us - flown.command_delay_us < detected->output_us);
  if (plan.pilot == kNoPilot) return;
  const CollisionEvidence evidence = evidence_of(plan, none, flown);
  const EscapeTimes times = escape_times(flown.agility, evidence);
  result.escape_left_s = times.left_s;
  result.escape_needed_s = times.needed_s;
  if (result.flown.hit || result.flown.crashed) {
    result.cause = to_text(collision_cause(flown.agility, evidence, times));
  }
}

}  // namespace dodgesim
