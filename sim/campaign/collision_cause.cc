#include "sim/campaign/collision_cause.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/gravity.h"

namespace dodgesim {

namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kAccelerations = 64;  // tried between none and the greatest; the least time is flat
constexpr int kDirections = 72;

// The part of v across the unit vector `along`.
Vector3d across(const Vector3d& v, const Vector3d& along) { return v - v.dot(along) * along; }

// Whether a vehicle that followed every command at once would have got out of the way, in the
// direction of the commands.
bool commanded_enough(const CollisionEvidence& evidence) {
  const auto e = escape_direction(*evidence.undisturbed, evidence.command_W);
  return e && e->dot(evidence.commanded_path_W) >= distance_to_escape_m(*evidence.undisturbed, *e);
}

}  // namespace

std::string to_text(CollisionCause cause) {
  switch (cause) {
    case CollisionCause::kNotSeen:
      return "not seen";
    case CollisionCause::kNotDetected:
      return "not detected";
    case CollisionCause::kSecondObject:
      return "second object";
    case CollisionCause::kSeenLate:
      return "seen late";
    case CollisionCause::kWrongPosition:
      return "wrong position";
    case CollisionCause::kWrongDirection:
      return "wrong direction";
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

Agility agility_of(const VehicleParameters& vehicle, const MotorSpec& motors) {
  Agility agility;
  agility.max_thrust_mps2 = 4 * vehicle.max_thrust_n / vehicle.mass_kg;
  // Full thrust on one side, none on the other.
  double roll_nm = 0, pitch_nm = 0;
  for (const Vector3d& p_B : vehicle.rotor_p_B) {
    roll_nm += 0.5 * vehicle.max_thrust_n * std::abs(p_B.y());
    pitch_nm += 0.5 * vehicle.max_thrust_n * std::abs(p_B.x());
  }
  agility.tilt_acceleration_radps2 =
      std::min(roll_nm / vehicle.inertia_kgm2.x(), pitch_nm / vehicle.inertia_kgm2.y());
  agility.dead_time_s = 1e-6 * motors.esc_delay_us + motors.time_constant_up_s;
  return agility;
}

double time_to_move_s(const Agility& agility, const Vector3d& direction_W, double distance_m) {
  if (distance_m <= 0) return 0;
  const double up = direction_W.z();
  const double level = std::sqrt(std::max(0.0, 1 - up * up));
  const double spare = std::pow(agility.max_thrust_mps2, 2) - std::pow(kGravityMps2 * level, 2);
  const double greatest = std::sqrt(std::max(0.0, spare)) - kGravityMps2 * up;
  double least_s = kInfinity;
  for (int i = 1; i <= kAccelerations; ++i) {
    const double a = greatest * i / kAccelerations;
    if (a <= 0) break;
    const double tilt_rad = std::atan2(a * level, kGravityMps2 + a * up);
    least_s = std::min(least_s, std::sqrt(tilt_rad / agility.tilt_acceleration_radps2) +
                                    std::sqrt(2 * distance_m / a));
  }
  return agility.dead_time_s + least_s;
}

std::optional<Vector3d> escape_direction(const Encounter& encounter, const Vector3d& direction_W) {
  const Vector3d sideways = across(direction_W, encounter.velocity_W.normalized());
  if (sideways.norm() <= 1e-6 * direction_W.norm()) return std::nullopt;
  return sideways.normalized();
}

double distance_to_escape_m(const Encounter& encounter, const Vector3d& escape_W) {
  return encounter.hull_reach_m(-escape_W) + encounter.object_radius_m +
         escape_W.dot(encounter.offset_W);
}

double time_to_escape_s(const Agility& agility, const Encounter& encounter,
                        const Vector3d& direction_W) {
  const std::optional<Vector3d> e = escape_direction(encounter, direction_W);
  return e ? time_to_move_s(agility, *e, distance_to_escape_m(encounter, *e)) : kInfinity;
}

double least_time_to_escape_s(const Agility& agility, const Encounter& encounter) {
  const Vector3d flight = encounter.velocity_W.normalized();
  const Vector3d a = flight.unitOrthogonal(), b = flight.cross(a);
  double least_s = kInfinity;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    least_s = std::min(
        least_s, time_to_escape_s(agility, encounter, std::cos(angle) * a + std::sin(angle) * b));
  }
  return least_s;
}

CollisionVerdict judge_collision(const Agility& agility, const CollisionEvidence& evidence) {
  CollisionVerdict verdict;
  const auto is = [&](CollisionCause cause) {
    verdict.cause = cause;
    return verdict;
  };
  if (evidence.landing) return is(CollisionCause::kLanding);
  if (!evidence.hit) {
    return is(evidence.evaded ? CollisionCause::kFledIntoTheRoom
                              : CollisionCause::kFlewIntoTheRoom);
  }
  if (evidence.another_detected_before) return is(CollisionCause::kSecondObject);
  if (evidence.undisturbed) {
    verdict.needed_s = least_time_to_escape_s(agility, *evidence.undisturbed);
    if (evidence.command_us) {
      verdict.left_s = seconds(evidence.undisturbed->contact_us - *evidence.command_us);
    }
  }
  if (evidence.perceives && !evidence.in_view) return is(CollisionCause::kNotSeen);
  if (evidence.perceives && !evidence.detected) return is(CollisionCause::kNotDetected);
  if (!evidence.undisturbed) return is(CollisionCause::kWrongDirection);
  if (!verdict.left_s || *verdict.left_s < *verdict.needed_s) return is(CollisionCause::kSeenLate);

  const auto in_time = [&](const Encounter& encounter) {
    return *verdict.left_s >= time_to_escape_s(agility, encounter, evidence.command_W);
  };
  if (in_time(*evidence.undisturbed)) {
    return is(commanded_enough(evidence) ? CollisionCause::kNotEnoughThrust
                                         : CollisionCause::kCommandedTooLittle);
  }
  Encounter believed = *evidence.undisturbed;
  believed.offset_W += evidence.position_error_W;
  return is(in_time(believed) ? CollisionCause::kWrongPosition : CollisionCause::kWrongDirection);
}

}  // namespace dodgesim
