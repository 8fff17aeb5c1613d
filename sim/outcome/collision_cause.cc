#include "sim/outcome/collision_cause.h"

namespace dodgesim {

namespace {

// Whether a vehicle that followed every command at once would have got out of the way.
bool commanded_enough(const CollisionEvidence& evidence) {
  const Encounter& encounter = *evidence.undisturbed;
  return passes(encounter, encounter.across_flight(evidence.commanded_path_W),
                encounter.across_flight(evidence.last_command_W));
}

}  // namespace

std::string to_text(CollisionCause cause) {
  switch (cause) {
    case CollisionCause::kNotSeen:
      return "not seen";
    case CollisionCause::kSeenFarOnly:
      return "seen far only";
    case CollisionCause::kNotDetected:
      return "not detected";
    case CollisionCause::kSecondObject:
      return "second object";
    case CollisionCause::kNotEvaded:
      return "not evaded";
    case CollisionCause::kSeenLate:
      return "seen late";
    case CollisionCause::kWrongPosition:
      return "wrong position";
    case CollisionCause::kWrongDirection:
      return "wrong direction";
    case CollisionCause::kDirectionTurned:
      return "direction turned";
    case CollisionCause::kCommandedTooLittle:
      return "commanded too little";
    case CollisionCause::kNotEnoughThrust:
      return "not enough thrust";
    case CollisionCause::kLanding:
      return "landing";
    case CollisionCause::kFledIntoTheRoom:
      return "fled into the room";
    case CollisionCause::kFlewIntoTheRoom:
      break;
  }
  return "flew into the room";
}

EscapeTimes escape_times(const Agility& agility, const CollisionEvidence& evidence) {
  EscapeTimes times;
  if (!evidence.undisturbed) return times;
  times.needed_s = least_time_to_escape_s(agility, *evidence.undisturbed);
  if (evidence.command_us) {
    times.left_s = seconds(evidence.undisturbed->contact_us - *evidence.command_us);
  }
  return times;
}

CollisionCause collision_cause(const Agility& agility, const CollisionEvidence& evidence,
                               const EscapeTimes& times) {
  if (evidence.landing) return CollisionCause::kLanding;
  if (!evidence.hit) {
    return evidence.evaded ? CollisionCause::kFledIntoTheRoom : CollisionCause::kFlewIntoTheRoom;
  }
  if (evidence.another_known_before) return CollisionCause::kSecondObject;
  if (evidence.perceives && !evidence.in_view) return CollisionCause::kNotSeen;
  if (evidence.perceives && !evidence.earliest_command_us) {
    return evidence.in_view_near ? CollisionCause::kNotDetected : CollisionCause::kSeenFarOnly;
  }
  if (!evidence.undisturbed) return CollisionCause::kWrongDirection;
  const auto in_time = [&times](const std::optional<double>& needed_s) {
    return times.left_s && needed_s && *times.left_s >= *needed_s;
  };
  const TimeUs contact_us = evidence.undisturbed->contact_us;
  const bool commanded = evidence.command_us && *evidence.command_us < contact_us;
  if (!commanded && evidence.earliest_command_us && times.needed_s &&
      seconds(contact_us - *evidence.earliest_command_us) >= *times.needed_s) {
    return CollisionCause::kNotEvaded;
  }
  if (!in_time(times.needed_s)) return CollisionCause::kSeenLate;

  const auto led_away = [&](const Encounter& encounter) {
    return in_time(least_time_to_escape_s(agility, encounter, evidence.command_W));
  };
  if (led_away(*evidence.undisturbed)) {
    if (evidence.turned) return CollisionCause::kDirectionTurned;
    return commanded_enough(evidence) ? CollisionCause::kNotEnoughThrust
                                      : CollisionCause::kCommandedTooLittle;
  }
  Encounter believed = *evidence.undisturbed;
  believed.object.p_W += evidence.position_error_W;
  return led_away(believed) ? CollisionCause::kWrongPosition : CollisionCause::kWrongDirection;
}

}  // namespace dodgesim
