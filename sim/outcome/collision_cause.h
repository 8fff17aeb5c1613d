// Why a flight came to harm, from the truth. A collision is held against what the vehicle's rotors
// allow, whatever its pilot and controller made of it (agility.h). A pilot that is told of objects
// detects one when it is first told of it:
//
//   not seen              the object's centre was never in view of a camera, and no detection was
//                         of it
//   seen far only         in view, but never while it was as near as the pilot believes detections
//                         (dodger.position.max_range_m; of a plug-in nobody knows), and no
//                         detection was of it
//   not detected          in view and near, but no detection was of it
//   second object         the pilot knew of another object before this one, or another would have
//                         hit a vehicle that stayed, so that nobody knows how this one would
//                         have met it
//   not evaded            a command sent at the first detection would have left some manoeuvre, but
//                         none came before the object did: the pilot did not believe what it had
//                         detected, or did not act on it
//   evaded late           likewise, but one came, when none of the manoeuvres that are tried would
//                         have brought the vehicle out of the way in time
//   seen late             not even a command sent at the first detection would have left one; or a
//                         pilot that is told of objects was not told of this one
//   wrong position        some manoeuvre was left, but none that led where the commands did, which
//                         would have been right had the object been where it was detected
//   wrong direction       some manoeuvre was left, but none that led where the commands did; or
//                         nothing would have happened without the evasion
//   direction turned      the commanded direction was right and the command early enough, but a
//                         later command before the object came led back, more than a right angle
//                         from the first, early enough for the rotors to follow it, or so far that
//                         even a vehicle that follows at once would have been hit; such a one would
//                         have got away without. (Whether this one would have only another flight
//                         can tell.)
//   commanded too little  the commanded direction was right and the command early enough, but even
//                         a vehicle that follows every command at once would not have got out of
//                         the way: the pilot asked for too low a speed, or stopped too early
//   not enough thrust     such a vehicle would have got out of the way: this one or its controller
//                         did not follow as fast as the bound of agility.h, which no vehicle with
//                         its rotors quite reaches
//   rebound               the object hit after it had touched the room, and would not have hit so
//                         late a vehicle that stayed
//   landing               the pilot had begun an emergency landing before, on which it dodges
//                         nobody
//   fled into the room    no object touched the vehicle, but it touched the room, having evaded
//   flew into the room    likewise, without having evaded: its estimate or its mission led it there
#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>

#include "sim/base/time.h"
#include "sim/outcome/agility.h"

namespace dodgesim {

enum class CollisionCause {
  kNotSeen,
  kSeenFarOnly,
  kNotDetected,
  kSecondObject,
  kNotEvaded,
  kEvadedLate,
  kSeenLate,
  kWrongPosition,
  kWrongDirection,
  kDirectionTurned,
  kCommandedTooLittle,
  kNotEnoughThrust,
  kRebound,
  kLanding,
  kFledIntoTheRoom,
  kFlewIntoTheRoom,
};

inline constexpr std::array kCollisionCauses = {CollisionCause::kNotSeen,
                                                CollisionCause::kSeenFarOnly,
                                                CollisionCause::kNotDetected,
                                                CollisionCause::kSecondObject,
                                                CollisionCause::kNotEvaded,
                                                CollisionCause::kEvadedLate,
                                                CollisionCause::kSeenLate,
                                                CollisionCause::kWrongPosition,
                                                CollisionCause::kWrongDirection,
                                                CollisionCause::kDirectionTurned,
                                                CollisionCause::kCommandedTooLittle,
                                                CollisionCause::kNotEnoughThrust,
                                                CollisionCause::kRebound,
                                                CollisionCause::kLanding,
                                                CollisionCause::kFledIntoTheRoom,
                                                CollisionCause::kFlewIntoTheRoom};

std::string to_text(CollisionCause cause);

// Where commands ask to go, all less the vehicle's velocity when the first evasive one arrived.
struct CommandedWay {
  Eigen::Vector3d mean_W = Eigen::Vector3d::Zero();  // of the evasive commands
  // How far the commands, evasive or not, lead from the course that the vehicle was on: their
  // integral from the first to the contact of CollisionEvidence::undisturbed. Each holds until the
  // next, the last to the contact.
  Eigen::Vector3d path_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d last_W = Eigen::Vector3d::Zero();  // the last one
};

// What is known of a flight. "The object" is the one that hit or, of a flight that was not hit,
// would have without evasion.
struct CollisionEvidence {
  bool hit = false;           // otherwise it came to harm, if it did, by crashing into the room
  bool evaded = false;        // anything, at any time
  bool landing = false;       // the pilot had begun an emergency landing
  bool rebound = false;       // it had touched the room; not so by the contact of `undisturbed`
  bool perceives = true;      // the pilot sees with its cameras; others are told of objects
  bool in_view = false;       // the object was, before the hit
  bool in_view_near = false;  // likewise, within the range that the pilot believes
  // When a command sent at the object's first detection, or when the pilot was told of it, would
  // have arrived; empty: there was none.
  std::optional<TimeUs> earliest_command_us;
  bool another_known_before = false;
  bool another_would_hit = false;        // so that nobody knows what `undisturbed` would have been
  std::optional<Encounter> undisturbed;  // empty: nothing would have happened, or another
  std::optional<TimeUs> command_us;      // first evasive command from earliest_command_us on
  CommandedWay commanded;  // by it and those after it, until the contact of `undisturbed`
  // The first evasive command of these that led back: across the flight of `undisturbed`, more than
  // a right angle from the first one. Both count from the vehicle's velocity when the first
  // arrived.
  struct Turn {
    TimeUs t_us = 0;
    CommandedWay before;  // had the last command before it held
  };
  std::optional<Turn> turn;
  // Of the object's newest detection before that command: detected less true position. What lies
  // along the flight means that it was believed to come that much sooner or later.
  Eigen::Vector3d position_error_W = Eigen::Vector3d::Zero();
};

struct EscapeTimes {
  // From the command's arrival to the contact without evasion. Empty without either.
  std::optional<double> left_s;
  std::optional<double> needed_s;  // least_time_to_escape_s(); empty without that contact, too
};
EscapeTimes escape_times(const Agility& agility, const CollisionEvidence& evidence);

// Of a flight that came to harm; `times` are its escape_times().
CollisionCause collision_cause(const Agility& agility, const CollisionEvidence& evidence,
                               const EscapeTimes& times);

}  // namespace dodgesim
