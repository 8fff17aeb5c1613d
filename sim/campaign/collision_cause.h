// Why a flight came to harm, from the truth. A collision is held against what the vehicle's rotors
// allow, whatever its pilot and controller made of it:
//
//   not seen              the object was never in view of a camera
//   not detected          in view, but no detection was of it
//   second object         the pilot had detected another object before this one
//   seen late             when the evasive command arrived, if it did, no direction was left in
//                         which the vehicle could have got out of the way in time
//   wrong position        some direction was left, but not the commanded one, which would have been
//                         right had the object been where it was detected
//   wrong direction       some direction was left, but not the commanded one; or nothing would have
//                         happened without the evasion
//   commanded too little  the commanded direction was right and the command early enough, but even
//                         a vehicle that follows every command at once would not have got out of
//                         the way: the pilot asked for too low a speed, or stopped too early
//   not enough thrust     such a vehicle would have got out of the way: this one or its controller
//                         did not follow as fast as its rotors allow
//   landing               the pilot had begun an emergency landing before, on which it dodges
//                         nobody
//   fled into the room    no object touched the vehicle, but it touched the room, having evaded
//   flew into the room    likewise, without having evaded: its estimate or its mission led it there
#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <optional>
#include <string>

#include "sim/base/time.h"
#include "sim/motors/motors.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

enum class CollisionCause {
  kNotSeen,
  kNotDetected,
  kSecondObject,
  kSeenLate,
  kWrongPosition,
  kWrongDirection,
  kCommandedTooLittle,
  kNotEnoughThrust,
  kLanding,
  kFledIntoTheRoom,
  kFlewIntoTheRoom,
};

inline constexpr std::array kCollisionCauses = {CollisionCause::kNotSeen,
                                                CollisionCause::kNotDetected,
                                                CollisionCause::kSecondObject,
                                                CollisionCause::kSeenLate,
                                                CollisionCause::kWrongPosition,
                                                CollisionCause::kWrongDirection,
                                                CollisionCause::kCommandedTooLittle,
                                                CollisionCause::kNotEnoughThrust,
                                                CollisionCause::kLanding,
                                                CollisionCause::kFledIntoTheRoom,
                                                CollisionCause::kFlewIntoTheRoom};

std::string to_text(CollisionCause cause);

// What the rotors of a hovering vehicle allow.
struct Agility {
  double max_thrust_mps2 = 0;           // of all rotors together, per mass
  double tilt_acceleration_radps2 = 0;  // greatest about the slower of the roll and pitch axes
  double dead_time_s = 0;               // delay and lag of the motors
};

Agility agility_of(const VehicleParameters& vehicle, const MotorSpec& motors);

// Least time in which a hovering vehicle moves by `distance_m` along the unit vector `direction_W`
// without leaving that line. To accelerate by a along e it needs the thrust |a e + g z|, tilted by
// theta; a tilt at full torque, reversed half-way, delays the motion by sqrt(theta / alpha):
//   t = dead time + sqrt(theta(a) / alpha) + sqrt(2 s / a), the least over all a that thrust
//   allows.
// 0 for a distance that is not positive.
double time_to_move_s(const Agility& agility, const Eigen::Vector3d& direction_W,
                      double distance_m);

// How object and vehicle meet if the vehicle does not evade.
struct Encounter {
  TimeUs contact_us = 0;
  Eigen::Vector3d offset_W = Eigen::Vector3d::Zero();    // object's centre from the vehicle's [m]
  Eigen::Vector3d velocity_W = Eigen::Vector3d::Zero();  // of the object against the vehicle [m/s]
  double object_radius_m = 0;
  // How far the vehicle's hull reaches from its centre in the direction of a unit vector in W [m].
  std::function<double(const Eigen::Vector3d&)> hull_reach_m;
};

// The unit vector along the part of `direction_W` across the relative velocity; empty if there is
// none.
std::optional<Eigen::Vector3d> escape_direction(const Encounter& encounter,
                                                const Eigen::Vector3d& direction_W);

// How far the vehicle must move along an escape direction to be out of the way of the encounter:
// until a plane that holds the line of flight divides it from the object.
double distance_to_escape_m(const Encounter& encounter, const Eigen::Vector3d& escape_W);

// Least time to get out of the way of the encounter along escape_direction(); infinite if there is
// none.
double time_to_escape_s(const Agility& agility, const Encounter& encounter,
                        const Eigen::Vector3d& direction_W);

// The least over all directions across the relative velocity, in steps of 5 degrees.
double least_time_to_escape_s(const Agility& agility, const Encounter& encounter);

// What is known of a flight that came to harm. "The object" is the one that hit.
struct CollisionEvidence {
  bool hit = false;       // otherwise it crashed into the room
  bool evaded = false;    // anything, at any time
  bool landing = false;   // the pilot had begun an emergency landing
  bool perceives = true;  // the pilot sees with its cameras; others are told of objects
  bool in_view = false;   // the object was, before the hit
  bool detected = false;  // the object was, before the hit
  bool another_detected_before = false;
  std::optional<Encounter> undisturbed;  // empty: nothing would have happened
  std::optional<TimeUs> command_us;      // first evasive command after the detection
  // Mean of the evasive commands until the contact of `undisturbed`, less the vehicle's velocity when
  // the first arrived.
  Eigen::Vector3d command_W = Eigen::Vector3d::Zero();
  // How far the commands, evasive or not, lead from the course that the vehicle was on when that
  // one arrived: the integral of commanded velocity less the vehicle's velocity at the first
  // command, from then to the contact of `undisturbed`. Each command holds until the next, the last
  // to the contact.
  Eigen::Vector3d commanded_path_W = Eigen::Vector3d::Zero();
  // Of the object's newest detection before that command: detected less true position.
  Eigen::Vector3d position_error_W = Eigen::Vector3d::Zero();
};

struct CollisionVerdict {
  CollisionCause cause = CollisionCause::kSeenLate;
  std::optional<double> left_s;    // from the command's arrival to the contact without evasion
  std::optional<double> needed_s;  // least time to escape, in any direction
};

CollisionVerdict judge_collision(const Agility& agility, const CollisionEvidence& evidence);

}  // namespace dodgesim
