#include "sim/outcome/collision_cause.h"

#include <iterator>

namespace dodgesim {

namespace {

// Whether a vehicle that followed every command at once would have got out of the way.
bool leads_out(const CommandedWay& way, const Encounter& encounter) {
  return passes(encounter, encounter.across_flight(way.path_W),
                encounter.across_flight(way.last_W));
}

// Of a command that came while some manoeuvre was left.
CollisionCause cause_of_answer(const Agility& agility, const CollisionEvidence& evidence,
                               double left_s) {
  const Encounter& encounter = *evidence.undisturbed;
  const auto led_away = [&](const Encounter& from, const CommandedWay& way) {
    const auto needed_s = least_time_to_escape_s(agility, from, way.mean_W);
    return needed_s && left_s >= *needed_s;
  };
  if (evidence.turn) {
    const CommandedWay& way = evidence.turn->before;
    const double left_to_turn_s = seconds(encounter.contact_us - evidence.turn->t_us);
    const bool followed = left_to_turn_s > agility.lag_s + agility.delay_s;
    if ((followed || !leads_out(evidence.commanded, encounter)) && led_away(encounter, way) &&
        leads_out(way, encounter)) {
      return CollisionCause::kDirectionTurned;
    }
  }
  if (led_away(encounter, evidence.commanded)) {
    return leads_out(evidence.commanded, encounter) ? CollisionCause::kNotEnoughThrust
                                                    : CollisionCause::kCommandedTooLittle;
  }
  Encounter believed = encounter;
  believed.object.p_W += evidence.position_error_W;
  return led_away(believed, evidence.commanded) ? CollisionCause::kWrongPosition
                                                : CollisionCause::kWrongDirection;
}

}  // namespace

std::string to_text(CollisionCause cause) {
  constexpr const char* kTexts[] = {"not seen",
                                    "seen far only",
                                    "not detected",
                                    "second object",
                                    "not evaded",
                                    "evaded late",
                                    "seen late",
                                    "wrong position",
                                    "wrong direction",
                                    "direction turned",
                                    "commanded too little",
                                    "not enough thrust",
                                    "rebound",
                                    "landing",
                                    "fled into the room",
                                    "flew into the room"};
  static_assert(std::size(kTexts) == kCollisionCauses.size());
  return kTexts[static_cast<std::size_t>(cause)];
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
  if (evidence.rebound) return CollisionCause::kRebound;
  const bool known = !evidence.perceives || evidence.earliest_command_us;
  if (!known && !evidence.in_view) return CollisionCause::kNotSeen;
  if (evidence.another_known_before) return CollisionCause::kSecondObject;
  if (!known) {
    return evidence.in_view_near ? CollisionCause::kNotDetected : CollisionCause::kSeenFarOnly;
  }
  if (evidence.another_would_hit) return CollisionCause::kSecondObject;
  if (!evidence.undisturbed) return CollisionCause::kWrongDirection;
  const TimeUs contact_us = evidence.undisturbed->contact_us;
  const auto in_time = [&](const std::optional<TimeUs>& command_us) {
    return command_us && times.needed_s && seconds(contact_us - *command_us) >= *times.needed_s;
  };
  if (in_time(evidence.command_us)) return cause_of_answer(agility, evidence, *times.left_s);
  if (!in_time(evidence.earliest_command_us)) return CollisionCause::kSeenLate;
  const bool commanded = evidence.command_us && *evidence.command_us < contact_us;
  return commanded ? CollisionCause::kEvadedLate : CollisionCause::kNotEvaded;
}

}  // namespace dodgesim
