#include "sim/outcome/collision_cause.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodgesim {
namespace {

using Eigen::Vector3d;

// About the nominal vehicle: 4 x 9.5 N on 1 kg.
const Agility kAgility{38, 404, 0.04, 0};

const Vector3d kLeft = Vector3d::UnitY(), kUp = Vector3d::UnitZ();

constexpr TimeUs kContactUs = 1000000;

// A ball of 20 cm flies at the middle of a flat box, head-on, and would touch it after 1 s.
Encounter head_on() {
  Encounter encounter;
  encounter.contact_us = kContactUs;
  encounter.object.p_W = {0.27, 0, 0};
  encounter.object.v_W = {-6, 0, 0};
  encounter.hull = {Convex::box(Eigen::Isometry3d::Identity(), {0.17, 0.17, 0.05})};
  encounter.shape = {Convex::sphere(Vector3d::Zero(), 0.1)};
  return encounter;
}

// The latest instant at which a command leads out of the way.
TimeUs last_us(const std::optional<Vector3d>& towards_W = std::nullopt,
               const Encounter& encounter = head_on()) {
  return kContactUs - std::lround(1e6 * *least_time_to_escape_s(kAgility, encounter, towards_W));
}

CollisionEvidence evidence(TimeUs command_us, const Vector3d& command_W) {
  CollisionEvidence evidence;
  evidence.hit = evidence.in_view = true;
  evidence.earliest_command_us = 0;
  evidence.undisturbed = head_on();
  evidence.command_us = command_us;
  evidence.commanded.mean_W = command_W;
  evidence.commanded.path_W = command_W.normalized();  // 1 m
  return evidence;
}

CollisionCause cause(const CollisionEvidence& evidence) {
  return collision_cause(kAgility, evidence, escape_times(kAgility, evidence));
}

TEST(CollisionCause, TellsWhatWasNotPerceived) {
  CollisionEvidence blind = evidence(0, kUp);
  blind.in_view = false;
  blind.earliest_command_us.reset();
  blind.command_us.reset();
  EXPECT_EQ(cause(blind), CollisionCause::kNotSeen);
  blind.another_known_before = true;
  EXPECT_EQ(cause(blind), CollisionCause::kNotSeen);
  blind.another_known_before = false;
  blind.in_view = true;
  EXPECT_EQ(cause(blind), CollisionCause::kSeenFarOnly);
  blind.in_view_near = true;
  EXPECT_EQ(cause(blind), CollisionCause::kNotDetected);
  blind.perceives = false;  // it is told of objects
  EXPECT_EQ(cause(blind), CollisionCause::kSeenLate);
}

TEST(CollisionCause, TooLateIsWhenNoManoeuvreIsLeft) {
  CollisionEvidence late = evidence(last_us() + 2, kUp);
  late.earliest_command_us = late.command_us;
  EXPECT_EQ(cause(late), CollisionCause::kSeenLate);
  const EscapeTimes times = escape_times(kAgility, late);
  EXPECT_NEAR(*times.left_s, *times.needed_s, 4e-6);
  EXPECT_LT(*times.left_s, *times.needed_s);
  EXPECT_EQ(cause(evidence(last_us(kUp) - 2, kUp)), CollisionCause::kNotEnoughThrust);
}

TEST(CollisionCause, WithoutACommandTheFirstDetectionTellsWhetherItWasSeenLate) {
  CollisionEvidence none = evidence(0, kUp);
  none.command_us.reset();
  EXPECT_FALSE(escape_times(kAgility, none).left_s);
  none.earliest_command_us = last_us() - 2;
  EXPECT_EQ(cause(none), CollisionCause::kNotEvaded);
  none.command_us = kContactUs;  // no answer either
  EXPECT_EQ(cause(none), CollisionCause::kNotEvaded);
  none.command_us = kContactUs - 1;
  EXPECT_EQ(cause(none), CollisionCause::kEvadedLate);
  none.command_us = last_us() + 2;
  EXPECT_EQ(cause(none), CollisionCause::kEvadedLate);
  none.command_us.reset();
  none.earliest_command_us = last_us() + 2;
  EXPECT_EQ(cause(none), CollisionCause::kSeenLate);
}

TEST(CollisionCause, ADirectionThatTakesTooLongIsWrongWhereAnotherWouldNot) {
  ASSERT_LT(last_us(kLeft) + 10000, last_us());
  EXPECT_EQ(cause(evidence(last_us(kLeft) + 2, kLeft)), CollisionCause::kWrongDirection);
  EXPECT_EQ(cause(evidence(last_us(kLeft) - 2, kLeft)), CollisionCause::kNotEnoughThrust);
  for (const TimeUs command_us : {100000, -500000}) {
    EXPECT_EQ(cause(evidence(command_us, {-5, 0, 0})), CollisionCause::kWrongDirection);
  }
}

// To the left the ball's radius and the hull's reach are 0.27 m.
TEST(CollisionCause, CommandsThatLeadTooShortAWayAreTooLittle) {
  CollisionEvidence timid = evidence(500000, kLeft);
  timid.commanded.path_W = 0.271 * kLeft;
  EXPECT_EQ(cause(timid), CollisionCause::kNotEnoughThrust);
  timid.commanded.path_W = 0.269 * kLeft;
  EXPECT_EQ(cause(timid), CollisionCause::kCommandedTooLittle);
  timid.undisturbed->object.p_W.y() = -0.01;  // the ball comes from the right
  EXPECT_EQ(cause(timid), CollisionCause::kNotEnoughThrust);
}

// The ball needs 17 ms from the contact to the box's middle.
TEST(CollisionCause, TheLastCommandGoesOnWhileTheBallPasses) {
  CollisionEvidence going_on = evidence(500000, kLeft);
  going_on.commanded.path_W = 0.25 * kLeft;
  EXPECT_EQ(cause(going_on), CollisionCause::kCommandedTooLittle);
  going_on.commanded.last_W = 5 * kLeft;
  EXPECT_EQ(cause(going_on), CollisionCause::kNotEnoughThrust);
}

TEST(CollisionCause, TheCommandedWayAlongTheFlightDoesNotCount) {
  CollisionEvidence swerving = evidence(500000, kLeft);
  swerving.commanded.path_W = {-3, 0.2, 0};
  EXPECT_EQ(cause(swerving), CollisionCause::kCommandedTooLittle);
  swerving.commanded.path_W = {-3, 0.3, 1};
  EXPECT_EQ(cause(swerving), CollisionCause::kNotEnoughThrust);
  swerving.commanded.path_W = {0, -0.2, 0};
  EXPECT_EQ(cause(swerving), CollisionCause::kCommandedTooLittle);
}

// To the left until `turn_us`, then back so far that all commands together lead nowhere.
CollisionEvidence turned_back(TimeUs command_us, TimeUs turn_us) {
  CollisionEvidence evidence = dodgesim::evidence(command_us, {-5, 0, 0});
  evidence.commanded.path_W.setZero();
  evidence.turn = {turn_us, {kLeft, kLeft, kLeft}};
  return evidence;
}

TEST(CollisionCause, CommandsThatLeadBackAreTurned) {
  const TimeUs in_time_us = last_us(kLeft) - 2;
  const CollisionEvidence turned = turned_back(in_time_us, in_time_us + 20000);
  EXPECT_EQ(cause(turned), CollisionCause::kDirectionTurned);
  // The first way was too short, or too late, all the same.
  CollisionEvidence timid = turned;
  timid.turn->before.path_W = timid.turn->before.last_W = 0.1 * kLeft;
  EXPECT_EQ(cause(timid), CollisionCause::kWrongDirection);
  EXPECT_EQ(cause(turned_back(last_us(kLeft) + 2, in_time_us + 20000)),
            CollisionCause::kWrongDirection);
}

TEST(CollisionCause, AWrongDirectionThatIsCorrectedIsNotTurned) {
  CollisionEvidence corrected = evidence(500000, kLeft);
  corrected.turn = {504000, {{-5, 0, 0}, {-3, 0, 0}, {-5, 0, 0}}};
  EXPECT_EQ(cause(corrected), CollisionCause::kNotEnoughThrust);
  corrected.commanded.path_W = 0.1 * kLeft;
  EXPECT_EQ(cause(corrected), CollisionCause::kCommandedTooLittle);
}

// A turn that the rotors' lag keeps from the vehicle is no cause, unless even one that follows at
// once would have been led back.
TEST(CollisionCause, ATurnThatTheRotorsDoNotFollowAnyMoreIsNoCause) {
  const TimeUs lag_us = 40000;
  CollisionEvidence late = turned_back(500000, kContactUs - lag_us + 1000);
  late.commanded.path_W = late.commanded.mean_W = kLeft;
  EXPECT_EQ(cause(late), CollisionCause::kNotEnoughThrust);
  late.turn->t_us = kContactUs - lag_us - 1000;
  EXPECT_EQ(cause(late), CollisionCause::kDirectionTurned);
  late.turn->t_us = kContactUs - lag_us + 1000;
  late.commanded.path_W.setZero();
  EXPECT_EQ(cause(late), CollisionCause::kDirectionTurned);
}

TEST(CollisionCause, TooLateOrTheWrongWayIsNotTooLittle) {
  for (const TimeUs command_us : {last_us() + 2, last_us(kLeft) + 2}) {
    CollisionEvidence late = evidence(command_us, kLeft);
    const CollisionCause before = cause(late);
    late.commanded.path_W.setZero();
    EXPECT_EQ(cause(late), before);
  }
}

TEST(CollisionCause, ADirectionThatFitsWhatWasDetectedIsAWrongPosition) {
  CollisionEvidence misled = evidence(last_us(kLeft) + 2, kLeft);
  misled.position_error_W = {0, -0.1, 0};  // detected too far to the right
  EXPECT_EQ(cause(misled), CollisionCause::kWrongPosition);
  misled.position_error_W = {0, 0.1, 0};
  EXPECT_EQ(cause(misled), CollisionCause::kWrongDirection);
}

TEST(CollisionCause, AnObjectDetectedTooFarAwayIsBelievedToComeLater) {
  CollisionEvidence misled = evidence(last_us(kLeft) + 2, kLeft);
  misled.position_error_W = {0.4, 0, 0};
  EXPECT_EQ(cause(misled), CollisionCause::kWrongPosition);
  misled.position_error_W = {-0.4, 0, 0};
  EXPECT_EQ(cause(misled), CollisionCause::kWrongDirection);
}

TEST(CollisionCause, WhatNoManoeuvreEscapesIsAlwaysSeenLate) {
  const Agility weak{9.82, 1e-3, 10, 0.9};
  const CollisionEvidence early = evidence(-500000, kUp);
  EXPECT_EQ(collision_cause(weak, early, escape_times(weak, early)), CollisionCause::kSeenLate);
}

TEST(CollisionCause, AHitThatOnlyTheEvasionBroughtIsAWrongDirection) {
  CollisionEvidence walked_into = evidence(500000, kUp);
  walked_into.undisturbed.reset();
  EXPECT_EQ(cause(walked_into), CollisionCause::kWrongDirection);
}

TEST(CollisionCause, TheSecondObjectAndTheRoomAreCausesOfTheirOwn) {
  CollisionEvidence second = evidence(500000, kUp);
  second.another_known_before = true;
  EXPECT_EQ(cause(second), CollisionCause::kSecondObject);
  second.hit = false;
  EXPECT_EQ(cause(second), CollisionCause::kFlewIntoTheRoom);
  second.evaded = true;
  EXPECT_EQ(cause(second), CollisionCause::kFledIntoTheRoom);
}

// Of a large object at the edge of the image parts are detected.
TEST(CollisionCause, WhatWasDetectedWasSeenWhereverItsCentreWas) {
  CollisionEvidence edge = evidence(last_us(kUp) - 2, kUp);
  edge.in_view = false;
  EXPECT_EQ(cause(edge), CollisionCause::kNotEnoughThrust);
}

TEST(CollisionCause, BehindAnotherObjectNobodyKnowsHowItWouldHaveMetAVehicleThatStayed) {
  CollisionEvidence second = evidence(500000, kUp);
  second.undisturbed.reset();
  second.another_would_hit = true;
  EXPECT_EQ(cause(second), CollisionCause::kSecondObject);
}

TEST(CollisionCause, WhatComesBackFromTheRoomReboundsWhateverWasDoneBefore) {
  CollisionEvidence rebound = evidence(500000, kUp);
  rebound.rebound = true;
  EXPECT_EQ(cause(rebound), CollisionCause::kRebound);
  rebound.landing = true;
  EXPECT_EQ(cause(rebound), CollisionCause::kLanding);
}

TEST(CollisionCause, WhoLandsDodgesNobody) {
  CollisionEvidence landing = evidence(500000, kUp);
  landing.landing = true;
  EXPECT_EQ(cause(landing), CollisionCause::kLanding);
  landing.hit = false;
  EXPECT_EQ(cause(landing), CollisionCause::kLanding);
}

}  // namespace
}  // namespace dodgesim
