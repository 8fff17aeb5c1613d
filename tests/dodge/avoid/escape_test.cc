#include "dodge/avoid/escape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "dodge/avoid/avoider.h"
#include "dodge/check_ranges.h"

namespace dodge {
namespace {

using Eigen::Vector3d;

constexpr double kGravityMps2 = 9.81;
constexpr double kSpeedMps = 5;

EscapeConfig closest_approach() {
  EscapeConfig config;
  config.law = "closest_approach";
  return config;
}

VehicleMotion at(const Vector3d& p_W, const Vector3d& v_W = Vector3d::Zero()) {
  VehicleMotion vehicle;
  vehicle.p_W = p_W;
  vehicle.v_W = v_W;
  return vehicle;
}

// A ball, now at p_W, that is at `target_W` after time_s of free fall.
TrackedObstacle ball(const Vector3d& p_W, const Vector3d& target_W, double time_s,
                     double velocity_sigma_mps = 0.1) {
  const Vector3d v_W = (target_W - p_W) / time_s + 0.5 * kGravityMps2 * time_s * Vector3d::UnitZ();
  TrackedObstacle ball = known_obstacle(0, 0, p_W, v_W, 0.2);
  ball.covariance.topLeftCorner<3, 3>() = 4e-4 * Eigen::Matrix3d::Identity();
  ball.covariance.bottomRightCorner<3, 3>() =
      velocity_sigma_mps * velocity_sigma_mps * Eigen::Matrix3d::Identity();
  return ball;
}

std::optional<Vector3d> escape_from(const std::vector<TrackedObstacle>& obstacles,
                                    const VehicleMotion& vehicle = at({0, 0, 2}),
                                    const Intent& intent = {}) {
  return EscapePlanner(closest_approach(), kSpeedMps).escape(0, vehicle, intent, obstacles);
}

TEST(EscapePlanner, FindsTheNearestPointOfAParabola) {
  const EscapePlanner planner(closest_approach(), kSpeedMps);
  const Vector3d vehicle_W(0, 0, 2);
  for (const double z : {-0.4, -0.1, 0.0, 0.3}) {
    for (const double time_s : {0.2, 0.45, 0.7}) {
      const TrackedObstacle thrown = ball({3, 1, 1.5}, {0, 0, 2 + z}, time_s);
      double nearest_m = 1e9;  // in steps of a millisecond
      for (int ms = 0; ms < 1000; ++ms) {
        const double t = 1e-3 * ms;
        const Vector3d p_W = thrown.obstacle.p_WO + t * thrown.obstacle.v_WO -
                             0.5 * kGravityMps2 * t * t * Vector3d::UnitZ();
        nearest_m = std::min(nearest_m, (p_W - vehicle_W).norm());
      }
      const auto meeting = planner.meeting(0, at(vehicle_W), {}, thrown);
      ASSERT_TRUE(meeting);
      EXPECT_NEAR(meeting->miss_W.norm(), nearest_m, 2e-3);
      EXPECT_NEAR(meeting->miss_W.dot(meeting->along_W), 0, 0.01);
    }
  }
}

// Wherever its goal is, a vehicle that has arrived there is at rest.
TEST(EscapePlanner, MeetsAtTheGoalAVehicleAtRest) {
  const EscapePlanner planner(closest_approach(), kSpeedMps);
  const auto meeting_at = [&](const Vector3d& offset_W) {
    Intent intent;
    intent.v_W = Vector3d(1.5, 0, 0);
    intent.p_WG = offset_W + Vector3d(0.3, 0.1, 0);
    return planner.meeting(
        0, at(offset_W, intent.v_W), intent,
        ball(offset_W + Vector3d(1, 3, 0), offset_W + Vector3d(0.4, 0.1, 0), 0.5));
  };
  const auto expected = meeting_at(Vector3d::Zero());
  ASSERT_TRUE(expected);
  for (int i = 0; i < 200; ++i) {
    const Vector3d offset_W(std::sin(1.0 * i), 3 * std::cos(2.0 * i), 2 + 0.013 * i);
    const auto meeting = meeting_at(offset_W);
    ASSERT_TRUE(meeting);
    EXPECT_LT((meeting->along_W - expected->along_W).norm(), 1e-6) << offset_W.transpose();
    EXPECT_LT((meeting->miss_W - expected->miss_W).norm(), 1e-6) << offset_W.transpose();
  }
}

// How far it still is when the horizon ends is no miss: only what it misses by to the side counts.
TEST(EscapePlanner, FollowsWhatComesBeyondTheHorizonStraightOn) {
  const EscapePlanner planner(closest_approach(), kSpeedMps);
  for (const double aside_m : {0.0, 0.3, -1.0}) {
    const TrackedObstacle thrown = ball({8, 0, 2}, {0, aside_m, 2}, 1.2);
    const auto meeting = planner.meeting(0, at({0, 0, 2}), {}, thrown);
    ASSERT_TRUE(meeting);
    EXPECT_NEAR(meeting->time_s, 1.2, 0.05);
    EXPECT_NEAR(meeting->miss_W.y(), aside_m, 0.05);
    EXPECT_NEAR(meeting->miss_W.dot(meeting->along_W), 0, 1e-9);
  }
}

// Of two balls the later one, beyond the horizon, is cleared as well: its way to the vehicle is no
// clearance.
TEST(EscapePlanner, ChoosesItsDirectionAlikeShortlyBeforeAndBeyondTheHorizon) {
  const TrackedObstacle near = ball({4, 0, 1.5}, {0, 0, 2}, 0.5);
  const auto direction = [&](double time_s) {
    return escape_from({near, ball({6, 3, 1.5}, {0, 0, 2.2}, time_s)})->normalized();
  };
  EXPECT_GT(direction(0.93).dot(direction(1.1)), 0.9);
}

TEST(EscapePlanner, PredictsTheCovarianceOfTheMiss) {
  TrackedObstacle thrown = ball({3, 0, 2}, {0, 0.2, 2}, 0.5);
  thrown.covariance.setZero();
  thrown.covariance.diagonal() << 1e-4, 4e-4, 9e-4, 0.04, 0.01, 0.16;
  thrown.covariance(1, 5) = thrown.covariance(5, 1) = 1e-3;
  const EscapeConfig config = closest_approach();
  // The state is 0.1 s old.
  const auto meeting = EscapePlanner(config, kSpeedMps).meeting(100000, at({0, 0, 2}), {}, thrown);
  ASSERT_TRUE(meeting);
  const double s = 0.1 + meeting->time_s;
  const double control = config.control_sigma_m * config.control_sigma_m;
  EXPECT_NEAR(meeting->covariance(0, 0), 1e-4 + s * s * 0.04 + control, 1e-9);
  EXPECT_NEAR(meeting->covariance(1, 1), 4e-4 + s * s * 0.01 + control, 1e-9);
  EXPECT_NEAR(meeting->covariance(2, 2), 9e-4 + s * s * 0.16 + control, 1e-9);
  EXPECT_NEAR(meeting->covariance(1, 2), s * 1e-3, 1e-9);
  EXPECT_NEAR(meeting->radius_m, config.hull_radius_m + 0.1, 1e-12);
}

TEST(EscapePlanner, PredictsHowGentlyTheVehicleBrakes) {
  const EscapeConfig config = closest_approach();
  const EscapePlanner planner(config, kSpeedMps);
  const Vector3d v_W(0, 4, 0);
  const TrackedObstacle thrown = ball({4, 0, 2}, {0, 1.5, 2}, 0.6);
  for (const double acceleration_mps2 : {3.0, 5.0}) {
    const Intent stop{Vector3d::Zero(), std::nullopt, acceleration_mps2};
    const auto meeting = planner.meeting(0, at({0, 0, 2}, v_W), stop, thrown);
    ASSERT_TRUE(meeting);
    const double t = meeting->time_s, braked_s = t - config.dead_time_s - config.tilt_time_s;
    const double ball_y = t * thrown.obstacle.v_WO.y();
    const double vehicle_y = 4 * t - 0.5 * acceleration_mps2 * braked_s * braked_s;
    EXPECT_NEAR(meeting->miss_W.y(), ball_y - vehicle_y, 2e-3) << acceleration_mps2;
  }
}

TEST(EscapePlanner, PredictsAnObstacleFromTheInstantOfItsState) {
  const EscapePlanner planner(closest_approach(), kSpeedMps);
  const TrackedObstacle thrown = ball({3, 0, 2}, {0, 0, 2}, 0.5);
  const auto meeting = planner.meeting(200000, at({0, 0, 2}), {}, thrown);
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->time_s, 0.3, 0.01);
}

TEST(EscapePlanner, EscapesFromWhatWillHitAndFromNothingElse) {
  EXPECT_TRUE(escape_from({ball({3, 0, 1.5}, {0, 0, 2}, 0.5)}));
  EXPECT_TRUE(escape_from({ball({3, 0, 1.5}, {0, 0.2, 2.1}, 0.5)}));
  EXPECT_FALSE(escape_from({ball({3, 0, 1.5}, {0, 1, 2}, 0.5)})) << "passes a metre to the left";
  EXPECT_FALSE(escape_from({ball({3, 0, 1.5}, {6, 0, 2}, 0.5)})) << "flies away";
  EXPECT_TRUE(escape_from({ball({4, 0, 1.5}, {0, 0, 2}, 0.95)}));
  EXPECT_FALSE(escape_from({ball({4, 0, 1.5}, {0, 0, 2}, 1.1)})) << "comes beyond the horizon";
  EXPECT_FALSE(escape_from({}));
  TrackedObstacle tentative = ball({3, 0, 1.5}, {0, 0, 2}, 0.5);
  tentative.confirmed = false;
  EXPECT_FALSE(escape_from({tentative}));
}

TEST(EscapePlanner, LeavesSlowThingsToTheGoal) {
  TrackedObstacle still = known_obstacle(0, 0, {1, 0, 2}, {0, 0, 0}, 0.2);
  EXPECT_FALSE(escape_from({still}, at({0, 0, 2}, {1.5, 0, 0}), {{1.5, 0, 0}, std::nullopt}));
}

// Where a lob turns it is slower than background sometimes seems to be.
TEST(EscapePlanner, EvadesOnWhatHasBecomeSlow) {
  const auto lob = [](int id) {
    TrackedObstacle lob = ball({0.5, 0, 2.2}, {0, 0, 2}, 0.35);
    lob.obstacle.id = id;
    return lob;
  };
  ASSERT_LT(lob(0).obstacle.v_WO.norm(), 2);
  EscapeConfig config = closest_approach();
  config.min_speed_mps = 2;
  EscapePlanner planner(config, kSpeedMps);
  const auto escape = [&](const TrackedObstacle& obstacle) {
    return planner.escape(0, at({0, 0, 2}), {}, std::array{obstacle}).has_value();
  };
  EXPECT_FALSE(escape(lob(0)));
  TrackedObstacle fast = ball({1, 0, 2}, {0, 0, 2}, 0.35);
  EXPECT_TRUE(escape(fast));
  EXPECT_TRUE(escape(lob(0)));
  EXPECT_FALSE(escape(lob(1))) << "another obstacle";
  EXPECT_FALSE(escape(lob(0))) << "it was gone; one of the same number is another";
}

TEST(EscapePlanner, KeepsToItsDirectionUntilAnotherIsClearlyBetter) {
  EscapePlanner planner(closest_approach(), kSpeedMps);
  const auto direction = [&](double aside_m, double velocity_sigma_mps) {
    const std::array thrown = {ball({3, 0, 2}, {0, aside_m, 2.25}, 0.4, velocity_sigma_mps)};
    return planner.escape(0, at({0, 0, 2}), {}, thrown)->normalized();
  };
  const Vector3d first_W = direction(0.05, 0.5);
  EXPECT_LT(first_W.y(), -0.5);
  EXPECT_EQ(direction(-0.05, 0.5), first_W) << "better by less than the estimate is uncertain";
  EXPECT_GT(direction(-0.2, 0.05).y(), 0.5) << "what is known well is worth a turn";
}

TEST(EscapePlanner, PlansTheNextEscapeAnew) {
  EscapePlanner planner(closest_approach(), kSpeedMps);
  const auto escape = [&](double aside_m) {
    const std::array thrown = {ball({3, 0, 2}, {0, aside_m, 2.25}, 0.4, 0.5)};
    return planner.escape(0, at({0, 0, 2}), {}, thrown);
  };
  const Vector3d left = *escape(-0.05);
  EXPECT_FALSE(planner.escape(0, at({0, 0, 2}), {}, {}));
  EXPECT_LT(escape(0.05)->y(), 0);
  EXPECT_GT(left.y(), 0);
}

TEST(EscapePlanner, WaitsUntilTheEstimateIsGoodEnough) {
  EXPECT_FALSE(escape_from({ball({3, 0, 1.5}, {0, 0, 2}, 0.5, 3)}));
  EXPECT_TRUE(escape_from({ball({3, 0, 1.5}, {0, 0, 2}, 0.5, 0.3)}));
}

TEST(EscapePlanner, DoesNotReturnIntoTheWayOfWhatItHasLostFromSight) {
  EscapePlanner planner(closest_approach(), kSpeedMps);
  const Intent hover{Vector3d::Zero(), Vector3d(0, 0, 2)};
  const std::vector sharp = {ball({3, 0, 1.5}, {0, 0, 2}, 0.5, 0.3)};
  const std::vector vague = {ball({3, 0, 1.5}, {0, 0, 2}, 0.5, 1.2)};
  EXPECT_FALSE(planner.escape(0, at({0, 0, 2}), hover, vague));
  EXPECT_TRUE(planner.escape(0, at({0, 0, 2}), hover, sharp));
  EXPECT_TRUE(planner.escape(0, at({0, 0, 2}), hover, vague));
  EXPECT_FALSE(planner.escape(600000, at({0, 0, 2}), hover, vague)) << "it has passed";
  EXPECT_FALSE(planner.escape(0, at({0, 0, 2}), hover, vague));
}

TEST(EscapePlanner, ReturnsHomeOnlyWhereNothingWillPass) {
  const VehicleMotion away = at({0, 0, 3.5});
  const std::vector thrown = {ball({3, 0, 1.5}, {0, 0, 2}, 0.9, 0.1)};
  const Intent home{{0, 0, -1.5}, Vector3d(0, 0, 2)};
  EXPECT_TRUE(escape_from(thrown, away, home)) << "it would be there in a second, and wait";
  EXPECT_FALSE(escape_from(thrown, away, {}));
}

TEST(EscapePlanner, EscapesAcrossTheLineOfFlightAndAwayFromTheMiss) {
  for (const double angle : {-1.5, -0.5, 0.4, 1.5, 2.6}) {
    const Vector3d miss(0, 0.15 * std::sin(angle), -0.15 * std::cos(angle));
    const std::vector thrown = {ball({3, 0, 2}, Vector3d(0, 0, 2) + miss, 0.4)};
    const auto escape_W = escape_from(thrown);
    ASSERT_TRUE(escape_W);
    EXPECT_NEAR(escape_W->norm(), kSpeedMps, 1e-9);
    const Vector3d v_W = thrown[0].obstacle.v_WO - 0.4 * kGravityMps2 * Vector3d::UnitZ();
    EXPECT_NEAR(escape_W->normalized().dot(v_W.normalized()), 0, 0.05);
    EXPECT_GE(escape_W->normalized().z(), -std::sin(15.1 * std::numbers::pi / 180));
    if (std::abs(angle) < 1.6) {
      EXPECT_GT(escape_W->dot(-miss), 0);
    }
  }
}

TEST(EscapePlanner, EscapesToTheOtherSideFromTheMirroredThrow) {
  const auto left = escape_from({ball({3, 0.5, 1.5}, {0, 0.2, 1.95}, 0.5)});
  const auto right = escape_from({ball({3, -0.5, 1.5}, {0, -0.2, 1.95}, 0.5)});
  ASSERT_TRUE(left && right);
  EXPECT_NEAR(left->x(), right->x(), 1e-6);
  EXPECT_NEAR(left->y(), -right->y(), 1e-6);
  EXPECT_NEAR(left->z(), right->z(), 1e-6);
}

TEST(EscapePlanner, EscapesFromTheSecondBallAsWell) {
  // Alone, the first is escaped from upward; the second passes there.
  const TrackedObstacle first = ball({3, 0, 2}, {0, 0, 1.9}, 0.4);
  const TrackedObstacle second = ball({3, 0, 2.8}, {0, 0, 2.7}, 0.45);
  const auto alone = escape_from({first});
  const auto both = escape_from({first, second});
  ASSERT_TRUE(alone && both);
  EXPECT_GT(alone->normalized().z(), 0.9);
  EXPECT_LT(both->normalized().z(), 0.75);
}

TEST(EscapePlanner, GainsClearanceOnEveryThrowThatWouldHit) {
  constexpr TimeUs kStepUs = 4000;
  constexpr double kStepS = 4e-3, kLagS = 0.1;
  for (const double speed_mps : {4.0, 6.0, 8.0}) {
    for (const double bearing : {-0.5, 0.0, 0.5}) {
      for (const double offset : {-0.2, 0.0, 0.2}) {
        const Vector3d start(3 * std::cos(bearing), 3 * std::sin(bearing), 1.5);
        TrackedObstacle thrown = ball(start, {0, offset, 2 + offset}, 3 / speed_mps);
        EscapePlanner planner(closest_approach(), kSpeedMps);
        VehicleMotion vehicle = at({0, 0, 2});
        double nearest_m = 1e9;
        for (TimeUs now = 0; now < 900000; now += kStepUs) {
          const double t = 1e-6 * static_cast<double>(now);
          const Vector3d p_W = thrown.obstacle.p_WO + t * thrown.obstacle.v_WO -
                               0.5 * kGravityMps2 * t * t * Vector3d::UnitZ();
          nearest_m = std::min(nearest_m, (p_W - vehicle.p_W).norm());
          const Intent home{Vector3d(0, 0, 2) - vehicle.p_W, Vector3d(0, 0, 2)};
          const auto escape_W = planner.escape(now, vehicle, home, std::array{thrown});
          vehicle.v_W += (escape_W.value_or(home.v_W) - vehicle.v_W) * (kStepS / kLagS);
          vehicle.p_W += kStepS * vehicle.v_W;
        }
        EXPECT_GT(nearest_m, 0.35) << speed_mps << " m/s, bearing " << bearing << ", " << offset;
      }
    }
  }
}

TEST(Avoider, EscapesByClosestApproachInPlaceOfTheField) {
  Avoider avoider({}, {}, {}, closest_approach());
  StateEstimate state;
  state.p_WB = {0, 0, 2};
  const Goal goal{.p_WG = state.p_WB};
  const std::array passing = {ball({1.5, 0, 2}, {0, 1, 2}, 0.3)};
  const std::array hitting = {ball({1.5, 0, 2}, {0, 0, 2}, 0.3)};
  EXPECT_TRUE(Avoider({}, {}, {}, {}).command(0, state, goal, passing).evading);
  EXPECT_FALSE(avoider.command(0, state, goal, passing).evading);
  const VelocityCommand escape = avoider.command(0, state, goal, hitting);
  EXPECT_TRUE(escape.evading);
  EXPECT_NEAR(escape.v_W.norm(), VelocityLimitConfig{}.max_speed_mps, 1e-9);
}

// Braking hard, the vehicle would stop before the ball's path; gently, it drifts into it.
TEST(Avoider, EscapesFromWhatItWouldDriftInto) {
  StateEstimate state;
  state.p_WB = {0, 0, 2};
  state.v_WB = {0, 4, 0};
  const Goal goal{.p_WG = state.p_WB};
  const std::array crossing = {ball({4, 1.8, 2}, {0, 1.8, 2}, 0.6)};
  const auto evades = [&](double calm_acceleration_mps2) {
    const VelocityLimitConfig limit{.calm_acceleration_mps2 = calm_acceleration_mps2};
    Avoider avoider({}, {}, limit, closest_approach());
    const std::array before = {ball(state.p_WB + Vector3d(1.5, 0, 0), state.p_WB, 0.3)};
    EXPECT_TRUE(avoider.command(-4000, state, goal, before).evading);
    return avoider.command(0, state, goal, crossing).evading;
  };
  EXPECT_FALSE(evades(0));
  EXPECT_TRUE(evades(4));
}

TEST(EscapeConfig, RefusesValuesThatMakeNoSense) {
  EscapeConfig config;
  config.law = "panic";
  EXPECT_THROW(check_ranges(config), std::invalid_argument);
  config = {};
  config.acceleration_mps2 = 0;
  EXPECT_THROW(check_ranges(config), std::invalid_argument);
}

}  // namespace
}  // namespace dodge
