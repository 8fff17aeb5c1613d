#include "dodge/avoid/avoider.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/dodge/generator.h"

namespace dodge {
namespace {

using Eigen::Vector3d;

RepulsiveConfig escape(const char* direction, bool upward) {
  RepulsiveConfig config;
  config.direction = direction;
  config.upward = upward;
  return config;
}

StateEstimate hovering(const Vector3d& p_WB = Vector3d::Zero(), double yaw_rad = 0) {
  StateEstimate state;
  state.p_WB = p_WB;
  state.q_WB = Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ());
  return state;
}

VelocityCommand command_for(const RepulsiveConfig& config, const StateEstimate& state,
                            const Vector3d& p, const Vector3d& v) {
  const std::array obstacles = {known_obstacle(0, state.t_us, p, v, 0.2)};
  Goal goal;
  goal.p_WG = state.p_WB;
  return Avoider(config, {}, {}, {}).command(state.t_us, state, goal, obstacles);
}

EscapeConfig by_law(const char* law) {
  EscapeConfig config;
  config.law = law;
  return config;
}

struct Flight {
  double clearance_m = 0;          // least distance between the centres
  double clearance_without_m = 0;  // had the vehicle stayed where it was
};

// A ball on a straight line towards a hovering point mass whose velocity follows the command with a
// first-order lag, its state known from `range_m` on.
Flight fly(const RepulsiveConfig& config, const Vector3d& offset, const Vector3d& v, double from_m,
           double range_m) {
  constexpr TimeUs kStepUs = 1000;
  constexpr double kStepS = 1e-3, kLagS = 0.1;
  Avoider avoider(config, {}, {}, {});
  Vector3d ball = offset - from_m * v.normalized();
  StateEstimate state = hovering();
  std::vector<TrackedObstacle> obstacles;
  Flight flight{1e9, 1e9};
  for (; state.t_us < 1500000; state.t_us += kStepUs) {
    const double distance = (ball - state.p_WB).norm();
    flight.clearance_m = std::min(flight.clearance_m, distance);
    flight.clearance_without_m = std::min(flight.clearance_without_m, ball.norm());
    if (distance < range_m) obstacles = {known_obstacle(0, state.t_us, ball, v, 0.2)};
    const VelocityCommand command = avoider.command(state.t_us, state, Goal{}, obstacles);
    state.v_WB += (command.v_W - state.v_WB) * (kStepS / kLagS);
    state.p_WB += kStepS * state.v_WB;
    ball += kStepS * v;
  }
  return flight;
}

class EveryEscape : public ::testing::TestWithParam<RepulsiveConfig> {};
INSTANTIATE_TEST_SUITE_P(Avoider, EveryEscape,
                         ::testing::Values(escape("cross", true), escape("cross", false),
                                           escape("away", false)),
                         [](const auto& info) {
                           return info.param.direction + (info.param.upward ? "_upward" : "");
                         });

TEST_P(EveryEscape, GainsClearanceOnThrowsFromTheFrontAtAnyOffset) {
  for (double y = -0.3; y < 0.31; y += 0.1) {
    for (double z = -0.3; z < 0.31; z += 0.1) {
      for (const double bearing : {-0.5, 0.0, 0.5}) {
        const Vector3d v(-5 * std::cos(bearing), -5 * std::sin(bearing), 0);
        const Flight flight = fly(GetParam(), {0, y, z}, v, 3.5, 3.5);
        EXPECT_GT(flight.clearance_m, flight.clearance_without_m + 0.3)
            << "offset " << y << " " << z << " bearing " << bearing;
        EXPECT_GT(flight.clearance_m, 0.5);
      }
    }
  }
}

TEST_P(EveryEscape, GainsClearanceOnAnExactlyHeadOnThrow) {
  for (const double range_m : {1.5, 3.5}) {
    EXPECT_GT(fly(GetParam(), Vector3d::Zero(), {-5, 0, 0}, 3.5, range_m).clearance_m, 0.4);
    // Falling at 53 degrees. Of (29), (30) leaves the upward part, along the path: less is gained.
    EXPECT_GT(fly(GetParam(), Vector3d::Zero(), {-3, 0, -4}, 3.5, range_m).clearance_m, 0.2);
  }
}

TEST_P(EveryEscape, TurnsWithTheScene) {
  Generator random(1);
  for (int k = 0; k < 200; ++k) {
    const Vector3d p = random.uniform_vector(-2, 2), v = 5 * random.normal_vector();
    const double yaw = random.uniform(-4, 4);
    const Eigen::Matrix3d R = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
    const Vector3d shift = random.uniform_vector(-5, 5);
    const Vector3d command = command_for(GetParam(), hovering(), p, v).v_W;
    const Vector3d turned = command_for(GetParam(), hovering(shift, yaw), R * p + shift, R * v).v_W;
    EXPECT_TRUE(turned.isApprox(R * command, 1e-9)) << turned.transpose();
  }
}

TEST(Avoider, StaysFiniteAndWithinTheLimitForAnyInput) {
  Generator random(2);
  RepulsiveConfig config;
  for (int k = 0; k < 20000; ++k) {
    // Coordinates that are often exactly 0 or 1, so that points coincide and vectors align.
    const auto scalar = [&] {
      const auto pick = random.bits() % 8;
      return pick < 3 ? 0.0 : pick < 4 ? 1.0 : pick < 5 ? -1.0 : random.uniform(-3, 3);
    };
    const auto vector = [&] { return Vector3d(scalar(), scalar(), scalar()); };
    config.field = random.bits() % 4 == 0 ? "khosla" : "falanga";
    constexpr const char* kDirections[] = {"cross", "away", "gradient"};
    config.direction = kDirections[random.bits() % 3];
    config.upward = random.bits() % 2 == 0;
    config.head_on_sine = std::abs(scalar()) / 3;
    config.steep_deg = 30 * std::abs(scalar());
    StateEstimate state;
    state.p_WB = vector();
    state.v_WB = vector();
    state.q_WB = Eigen::Quaterniond(scalar(), scalar(), scalar(), scalar());
    std::array<TrackedObstacle, 2> obstacles;
    for (TrackedObstacle& tracked : obstacles) {
      tracked = known_obstacle(0, 0, vector(), vector(), std::abs(scalar()));
      tracked.ellipsoid.semi_axes_m = vector().cwiseAbs();
    }
    Goal goal;
    goal.p_WG = vector();
    // The second law costs a hundred times as much.
    const char* law = k % 20 == 0 ? "closest_approach" : "potential_field";
    const VelocityCommand command =
        Avoider(config, {}, {}, by_law(law))
            .command(static_cast<TimeUs>(random.bits() % 1000000), state, goal, obstacles);
    ASSERT_TRUE(command.v_W.allFinite()) << k << " " << law;
    ASSERT_LE(command.v_W.norm(), 5 + 1e-9);
  }
}

TEST_P(EveryEscape, ObstaclesThatAreNotFiniteDoNotAct) {
  Goal goal;
  goal.p_WG = {5, 0, 0};
  for (const char* law : {"potential_field", "closest_approach"}) {
    const auto command = [&](const std::vector<TrackedObstacle>& obstacles) {
      return Avoider(GetParam(), {}, {}, by_law(law)).command(0, {}, goal, obstacles);
    };
    const TrackedObstacle good = known_obstacle(0, 0, {2, 0.1, 0}, {-6, 0, 1.6}, 0.2);
    const Vector3d alone = command({}).v_W, escape = command({good}).v_W;
    ASSERT_TRUE(command({good}).evading) << law;
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      for (int k = 0; k < 5; ++k) {
        TrackedObstacle tracked = good;
        if (k == 0) tracked.obstacle.v_WO.y() = bad;
        if (k == 1) tracked.obstacle.p_WO.y() = tracked.ellipsoid.centre_W.y() = bad;
        if (k == 2) tracked.ellipsoid.semi_axes_m.y() = bad;
        if (k == 3) tracked.covariance(0, 0) = bad;
        if (k == 4) tracked.obstacle.size_m = bad;
        EXPECT_EQ(command({tracked}).v_W, alone) << law << " " << k;
        EXPECT_FALSE(command({tracked}).evading) << law << " " << k;
        EXPECT_EQ(command({tracked, good}).v_W, escape) << law << " " << k;
      }
    }
  }
}

Vector3d mirrored(const Vector3d& v) { return {v.x(), -v.y(), v.z()}; }

TEST(Avoider, IsMirrorSymmetricWhereItEscapesAway) {
  Generator random(3);
  for (int k = 0; k < 200; ++k) {
    const Vector3d p = random.uniform_vector(-2, 2), v = 5 * random.normal_vector();
    const RepulsiveConfig config = escape("away", false);
    const Vector3d command = command_for(config, hovering(), p, v).v_W;
    const Vector3d mirror = command_for(config, hovering(), mirrored(p), mirrored(v)).v_W;
    EXPECT_TRUE(mirror.isApprox(mirrored(command), 1e-9)) << command.transpose();
  }
}

TEST(Avoider, AsInThePaperEscapesToTheSameSideFromAMirroredThrow) {
  // A cross product changes its sign in a mirror, and |F_z| takes back only the vertical part.
  const Vector3d p(2, 0.2, 0.3), v(-5, 0, 0);
  const Vector3d command = command_for({}, hovering(), p, v).v_W;
  EXPECT_GT(command.y(), 1);
  EXPECT_TRUE(command_for({}, hovering(), mirrored(p), v).v_W.isApprox(command, 1e-9));
}

TEST(Avoider, FliesToTheGoalWithoutObstacles) {
  Goal goal;
  goal.p_WG = Vector3d(3, 0, 4);
  const VelocityCommand command = Avoider({}, {}, {}, {}).command(7, hovering(), goal, {});
  EXPECT_TRUE(command.v_W.isApprox(Vector3d(0.9, 0, 1.2), 1e-9));
  EXPECT_FALSE(command.evading);
  EXPECT_EQ(command.t_us, 7);
}

TEST(Avoider, IgnoresObstaclesThatAreNotConfirmed) {
  std::array obstacles = {known_obstacle(0, 0, {1.5, 0, 0}, {-5, 0, 0}, 0.2)};
  Avoider avoider({}, {}, {}, {});
  EXPECT_TRUE(avoider.command(0, hovering(), Goal{}, obstacles).evading);
  obstacles[0].confirmed = false;
  EXPECT_FALSE(avoider.command(0, hovering(), Goal{}, obstacles).evading);
}

TEST(Avoider, MovesObstacleAndVehicleOnToTheInstantOfTheCommand) {
  Avoider avoider({}, {}, {}, {});
  StateEstimate state = hovering();
  state.v_WB = Vector3d(0, 1, 0);
  // 4.5 m away, out of the field, but 0.2 s later 3.5 m nearer.
  const std::array before = {known_obstacle(0, 0, {4.5, 0.2, 0.5}, {-17.5, 0, 0}, 0.2)};
  std::array then = {known_obstacle(0, 200000, {1, 0.2, 0.5}, {-17.5, 0, 0}, 0.2)};
  then[0].obstacle.last_detection_us = 0;
  StateEstimate moved = state;
  moved.t_us = 200000;
  moved.p_WB = Vector3d(0, 0.2, 0);
  EXPECT_FALSE(avoider.command(0, state, Goal{}, before).evading);
  const VelocityCommand command = avoider.command(200000, state, Goal{}, before);
  EXPECT_TRUE(command.evading);
  EXPECT_TRUE(command.v_W.isApprox(avoider.command(200000, moved, Goal{}, then).v_W, 1e-9));
}

TEST(Avoider, AddsTheForcesOfAllObstaclesWithTheirVerticalPartsUpward) {
  RepulsiveConfig config;
  config.k_r0 = 0.01;  // below the speed limit
  const auto one = known_obstacle(0, 0, {1, 0.3, 0.1}, {-5, 0, 0}, 0.2);
  const auto other = known_obstacle(1, 0, {1, -0.2, -0.3}, {-4, 1, 0}, 0.3);
  Avoider avoider(config, {}, {}, {});
  const StateEstimate state = hovering();
  const auto v = [&](std::span<const TrackedObstacle> obstacles) {
    return avoider.command(0, state, Goal{}, obstacles).v_W;
  };
  const Vector3d sum = v(std::array{one}) + v(std::array{other});
  EXPECT_TRUE(v(std::array{one, other}).isApprox(sum, 1e-12));
  EXPECT_GT(v(std::array{one}).z(), 0);
  EXPECT_GT(v(std::array{other}).z(), 0);
}

TEST(Avoider, StopsEvadingAfterTheObstacleHasPassed) {
  Avoider avoider({}, {}, {}, {});
  const std::array obstacles = {known_obstacle(0, 0, {0.5, 0.3, 0}, {-5, 0, 0}, 0.2)};
  EXPECT_TRUE(avoider.command(200000, hovering(), Goal{}, obstacles).evading);   // 0.5 m behind
  EXPECT_FALSE(avoider.command(800000, hovering(), Goal{}, obstacles).evading);  // 3.5 m behind
}

TEST(Avoider, TakesTheHeadingWithoutTheTiltOfTheEscape) {
  const Vector3d p(2, 0.4, 0.3), v(-5, 1, 0);
  StateEstimate tilted = hovering();
  tilted.q_WB =
      Eigen::AngleAxisd(0.6, Vector3d::UnitY()) * Eigen::AngleAxisd(-0.8, Vector3d::UnitX());
  EXPECT_TRUE(
      command_for({}, tilted, p, v).v_W.isApprox(command_for({}, hovering(), p, v).v_W, 1e-9));
  StateEstimate nose_up = hovering();
  nose_up.q_WB = Eigen::AngleAxisd(-M_PI_2, Vector3d::UnitY());
  EXPECT_TRUE(
      command_for({}, nose_up, p, v).v_W.isApprox(command_for({}, hovering(), p, v).v_W, 1e-6));
}

}  // namespace
}  // namespace dodge
