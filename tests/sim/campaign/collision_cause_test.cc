#include "sim/campaign/collision_cause.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodgesim {
namespace {

using Eigen::Vector3d;

// About the nominal vehicle: 4 x 9.5 N on 1 kg.
const Agility kAgility{38, 404, 0.04};

const Vector3d kLeft = Vector3d::UnitY(), kUp = Vector3d::UnitZ();

// A ball of 20 cm flies at the middle of a flat box, head-on, and would touch it after 1 s.
Encounter head_on() {
  Encounter encounter;
  encounter.contact_us = 1000000;
  encounter.offset_W = {0.27, 0, 0};
  encounter.velocity_W = {-6, 0, 0};
  encounter.object_radius_m = 0.1;
  encounter.hull_reach_m = [](const Vector3d& d) {
    return Vector3d(0.17, 0.17, 0.05).dot(d.cwiseAbs());
  };
  return encounter;
}

CollisionEvidence evidence(TimeUs command_us, const Vector3d& command_W) {
  CollisionEvidence evidence;
  evidence.hit = evidence.in_view = evidence.detected = true;
  evidence.undisturbed = head_on();
  evidence.command_us = command_us;
  evidence.command_W = command_W;
  evidence.commanded_path_W = command_W.normalized();  // 1 m
  return evidence;
}

CollisionCause cause(const CollisionEvidence& evidence) {
  return judge_collision(kAgility, evidence).cause;
}

TEST(TimeToMove, UpwardNeedsNoTilt) {
  EXPECT_NEAR(time_to_move_s(kAgility, kUp, 0.15), 0.04 + std::sqrt(0.3 / (38 - 9.81)), 1e-12);
}

TEST(TimeToMove, SidewaysKeepsTheHeightAndTiltsFirst) {
  const double a = std::sqrt(38 * 38 - 9.81 * 9.81);
  const double tilt_s = std::sqrt(std::atan2(a, 9.81) / 404);
  EXPECT_NEAR(time_to_move_s(kAgility, kLeft, 0.27), 0.04 + tilt_s + std::sqrt(0.54 / a), 1e-12);
}

TEST(TimeToMove, GentleTiltsServeShortWaysAndSlowTilts) {
  const Agility sluggish{38, 20, 0.04};
  const double a = std::sqrt(38 * 38 - 9.81 * 9.81);
  const double full_s = 0.04 + std::sqrt(std::atan2(a, 9.81) / 20) + std::sqrt(0.02 / a);
  EXPECT_LT(time_to_move_s(sluggish, kLeft, 0.01), full_s - 0.02);
}

TEST(TimeToMove, NothingToDoTakesNoTime) { EXPECT_EQ(time_to_move_s(kAgility, kUp, -0.1), 0); }

TEST(TimeToEscape, CountsHullObjectAndOffset) {
  Encounter encounter = head_on();
  EXPECT_NEAR(time_to_escape_s(kAgility, encounter, kLeft), time_to_move_s(kAgility, kLeft, 0.27),
              1e-12);
  EXPECT_NEAR(time_to_escape_s(kAgility, encounter, kUp), time_to_move_s(kAgility, kUp, 0.15),
              1e-12);
  encounter.offset_W.y() = 0.1;  // the ball comes from the left
  EXPECT_NEAR(time_to_escape_s(kAgility, encounter, kLeft), time_to_move_s(kAgility, kLeft, 0.37),
              1e-12);
  EXPECT_NEAR(time_to_escape_s(kAgility, encounter, -kLeft), time_to_move_s(kAgility, -kLeft, 0.17),
              1e-12);
}

TEST(TimeToEscape, OnlyTheWayAcrossTheFlightCounts) {
  const Encounter encounter = head_on();
  EXPECT_TRUE(std::isinf(time_to_escape_s(kAgility, encounter, {-5, 0, 0})));
  EXPECT_NEAR(time_to_escape_s(kAgility, encounter, {-5, 0, 1}),
              time_to_escape_s(kAgility, encounter, kUp), 1e-12);
}

TEST(TimeToEscape, AFlatVehicleGetsAwayFastestUpward) {
  EXPECT_NEAR(least_time_to_escape_s(kAgility, head_on()),
              time_to_escape_s(kAgility, head_on(), kUp), 1e-12);
}

TEST(CollisionCause, TellsWhatWasNotPerceived) {
  CollisionEvidence blind = evidence(0, kUp);
  blind.in_view = blind.detected = false;
  blind.command_us.reset();
  EXPECT_EQ(cause(blind), CollisionCause::kNotSeen);
  blind.in_view = true;
  EXPECT_EQ(cause(blind), CollisionCause::kNotDetected);
  blind.perceives = false;  // it is told of objects
  EXPECT_EQ(cause(blind), CollisionCause::kSeenLate);
}

TEST(CollisionCause, TooLateIsWhenNoDirectionIsLeft) {
  // Upward it takes 0.143 s.
  const CollisionVerdict late = judge_collision(kAgility, evidence(860000, kUp));
  EXPECT_EQ(late.cause, CollisionCause::kSeenLate);
  EXPECT_DOUBLE_EQ(*late.left_s, 0.14);
  EXPECT_NEAR(*late.needed_s, 0.1432, 1e-4);
  EXPECT_EQ(cause(evidence(850000, kUp)), CollisionCause::kNotEnoughThrust);
}

TEST(CollisionCause, NoCommandAtAllIsTooLate) {
  CollisionEvidence none = evidence(0, kUp);
  none.command_us.reset();
  const CollisionVerdict verdict = judge_collision(kAgility, none);
  EXPECT_EQ(verdict.cause, CollisionCause::kSeenLate);
  EXPECT_FALSE(verdict.left_s);
}

TEST(CollisionCause, ADirectionThatTakesTooLongIsWrongWhereAnotherWouldNot) {
  // To the left it takes 0.218 s.
  EXPECT_EQ(cause(evidence(800000, kLeft)), CollisionCause::kWrongDirection);
  EXPECT_EQ(cause(evidence(750000, kLeft)), CollisionCause::kNotEnoughThrust);
  EXPECT_EQ(cause(evidence(100000, {-5, 0, 0})), CollisionCause::kWrongDirection);
}

// To the left the ball's radius and the hull's reach are 0.27 m.
TEST(CollisionCause, CommandsThatLeadTooShortAWayAreTooLittle) {
  CollisionEvidence timid = evidence(500000, kLeft);
  timid.commanded_path_W = 0.271 * kLeft;
  EXPECT_EQ(cause(timid), CollisionCause::kNotEnoughThrust);
  timid.commanded_path_W = 0.269 * kLeft;
  EXPECT_EQ(cause(timid), CollisionCause::kCommandedTooLittle);
  timid.undisturbed->offset_W.y() = -0.01;  // the ball comes from the right
  EXPECT_EQ(cause(timid), CollisionCause::kNotEnoughThrust);
}

TEST(CollisionCause, OnlyTheCommandedWayAlongTheEscapeCounts) {
  CollisionEvidence swerving = evidence(500000, kLeft);
  swerving.commanded_path_W = {-3, 0.2, 0};
  EXPECT_EQ(cause(swerving), CollisionCause::kCommandedTooLittle);
  swerving.commanded_path_W = {-3, 0.3, 1};
  EXPECT_EQ(cause(swerving), CollisionCause::kNotEnoughThrust);
  swerving.commanded_path_W = {0, -1, 0};  // back again
  EXPECT_EQ(cause(swerving), CollisionCause::kCommandedTooLittle);
}

TEST(CollisionCause, TooLateOrTheWrongWayIsNotTooLittle) {
  for (const TimeUs command_us : {900000, 800000}) {
    CollisionEvidence late = evidence(command_us, kLeft);
    const CollisionCause before = cause(late);
    late.commanded_path_W.setZero();
    EXPECT_EQ(cause(late), before);
  }
}

TEST(CollisionCause, ADirectionThatFitsWhatWasDetectedIsAWrongPosition) {
  CollisionEvidence misled = evidence(800000, kLeft);
  misled.position_error_W = {0, -0.1, 0};  // detected too far to the right: 0.193 s would do
  EXPECT_EQ(cause(misled), CollisionCause::kWrongPosition);
  misled.position_error_W = {0, 0.1, 0};
  EXPECT_EQ(cause(misled), CollisionCause::kWrongDirection);
}

TEST(CollisionCause, AHitThatOnlyTheEvasionBroughtIsAWrongDirection) {
  CollisionEvidence walked_into = evidence(500000, kUp);
  walked_into.undisturbed.reset();
  EXPECT_EQ(cause(walked_into), CollisionCause::kWrongDirection);
}

TEST(CollisionCause, TheSecondObjectAndTheRoomAreCausesOfTheirOwn) {
  CollisionEvidence second = evidence(500000, kUp);
  second.another_detected_before = true;
  EXPECT_EQ(cause(second), CollisionCause::kSecondObject);
  second.hit = false;
  EXPECT_EQ(cause(second), CollisionCause::kFlewIntoTheRoom);
  second.evaded = true;
  EXPECT_EQ(cause(second), CollisionCause::kFledIntoTheRoom);
}

TEST(CollisionCause, WhoLandsDodgesNobody) {
  CollisionEvidence landing = evidence(500000, kUp);
  landing.landing = true;
  EXPECT_EQ(cause(landing), CollisionCause::kLanding);
  landing.hit = false;
  EXPECT_EQ(cause(landing), CollisionCause::kLanding);
}

TEST(Agility, ComesFromRotorsAndInertia) {
  VehicleParameters vehicle;
  vehicle.mass_kg = 2;
  vehicle.inertia_kgm2 = {0.01, 0.01, 0.02};
  vehicle.max_thrust_n = 10;
  vehicle.rotor_p_B = {Vector3d(0.1, 0.2, 0), Vector3d(0.1, -0.2, 0), Vector3d(-0.1, -0.2, 0),
                       Vector3d(-0.1, 0.2, 0)};
  MotorSpec motors;
  motors.time_constant_up_s = 0.05;
  motors.esc_delay_us = 1000;
  const Agility agility = agility_of(vehicle, motors);
  EXPECT_DOUBLE_EQ(agility.max_thrust_mps2, 20);
  EXPECT_DOUBLE_EQ(agility.tilt_acceleration_radps2, 2 * 10 * 0.1 / 0.01);
  EXPECT_DOUBLE_EQ(agility.dead_time_s, 0.051);
}

}  // namespace
}  // namespace dodgesim
