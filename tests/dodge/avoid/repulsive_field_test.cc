#include "dodge/avoid/repulsive_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "dodge/check_ranges.h"
#include "tests/dodge/generator.h"

namespace dodge {
namespace {

using Eigen::Vector3d;

const Vector3d kForward = Vector3d::UnitX();

RepulsiveConfig config_with(double gamma, const char* field = "falanga") {
  RepulsiveConfig config;
  config.gamma = gamma;
  config.field = field;
  return config;
}

// A ball of 20 cm at p, seen now, from a hovering vehicle at the origin that looks along x.
Vector3d force_of_ball(const RepulsiveConfig& config, const Vector3d& p, const Vector3d& v) {
  return RepulsiveField(config).force(VehicleMotion{}, sphere(p, 0.1), v, 0);
}

TEST(RepulsiveMagnitude, FollowsEquation28AtHandComputedPoints) {
  const RepulsiveField field(config_with(1.5));  // eta_0 = 3 m
  // 1 - (e^1.5 - 1) / (e^4.5 - 1) = 1 - 3.481689 / 89.017131
  EXPECT_NEAR(field.magnitude(1, 4), 4 * 0.960887, 4e-6);
  EXPECT_NEAR(field.magnitude(2, 1), 1 - 19.085537 / 89.017131, 1e-7);
  EXPECT_NEAR(field.magnitude(0, 4), 4, 1e-12);
  EXPECT_NEAR(field.magnitude(3 - 1e-12, 4), 0, 1e-9);
  EXPECT_EQ(field.magnitude(3, 4), 0);
  EXPECT_EQ(field.magnitude(100, 4), 0);
}

TEST(RepulsiveMagnitude, StaysAtItsLimitWhenTheHullTouchesTheObstacle) {
  EXPECT_EQ(RepulsiveField(config_with(1.5)).magnitude(-0.3, 4), 4);
}

TEST(RepulsiveMagnitude, FallsWithDistanceAndStaysFiniteForAnyShape) {
  for (const double gamma : {0.1, 1.0, 1.5, 20.0}) {
    RepulsiveConfig config = config_with(gamma);
    config.eta_0_m = 100;  // e^(gamma eta_0) would overflow
    const RepulsiveField field(config);
    double previous = std::numeric_limits<double>::infinity();
    for (double eta = 0; eta <= 101; eta += 0.5) {
      const double magnitude = field.magnitude(eta, 4);
      EXPECT_TRUE(magnitude >= 0 && magnitude <= 4) << magnitude;
      EXPECT_LE(magnitude, previous);
      previous = magnitude;
    }
  }
}

TEST(RepulsiveMagnitude, OfTheClassicFieldIsTheSlopeOfItsPotential) {
  const RepulsiveField field(config_with(2, "khosla"));
  // 4 * 2 / 3 * (2 / 3)
  EXPECT_NEAR(field.magnitude(1, 4), 16.0 / 9, 1e-12);
  const auto potential = [](double eta) { return 4 * std::pow((3 - eta) / 3, 2.0); };  // (26)
  for (double eta = 0.1; eta < 3; eta += 0.2) {
    EXPECT_NEAR(field.magnitude(eta, 4), -(potential(eta + 1e-6) - potential(eta - 1e-6)) / 2e-6,
                1e-6);
  }
}

TEST(RepulsiveConstant, DecaysWithTheTimeSinceTheLastDetection) {
  const RepulsiveField field((RepulsiveConfig()));
  EXPECT_DOUBLE_EQ(field.k_r(0), 4);
  EXPECT_NEAR(field.k_r(0.1), 4 * 0.36787944, 1e-7);  // lambda = 10 1/s
  EXPECT_DOUBLE_EQ(field.k_r(-0.01), 4);  // a detection from the future does not amplify
  const double lifetime_s = decay_lifetime_s(RepulsiveConfig());
  EXPECT_NEAR(lifetime_s, std::log(4000.0) / 10, 1e-12);
  EXPECT_NEAR(field.k_r(lifetime_s), 0.001, 1e-12);
}

TEST(RepulsiveConstant, BelowTheRemovalThresholdGivesNoLifetime) {
  RepulsiveConfig config;
  config.k_r0 = 0;
  EXPECT_EQ(decay_lifetime_s(config), 0);
}

TEST(RepulsiveDirection, IsOrthogonalToObstacleVelocityAndGradient) {
  RepulsiveConfig config;
  config.upward = false;
  const RepulsiveField field(config);
  // Obstacle above the line of flight: gradient (-3, 0, -0.4) x velocity (-5, 0, 0) = (0, 2, 0).
  EXPECT_TRUE(field.direction(Vector3d(-3, 0, -0.4).normalized(), {-5, 0, 0}, kForward)
                  .isApprox(Vector3d::UnitY()));
  // Obstacle to the left: gradient (-3, -0.4, 0) x velocity (-5, 0, 0) = (0, 0, -2).
  EXPECT_TRUE(field.direction(Vector3d(-3, -0.4, 0).normalized(), {-5, 0, 0}, kForward)
                  .isApprox(-Vector3d::UnitZ()));
}

TEST(RepulsiveDirection, IsOrthogonalToTheHeadingAndOfUnitLength) {
  const RepulsiveField field((RepulsiveConfig()));
  Generator random(1);
  for (int k = 0; k < 1000; ++k) {
    const double yaw = random.uniform(-4, 4);
    const Vector3d heading(std::cos(yaw), std::sin(yaw), 0);
    const Vector3d direction =
        field.direction(random.normal_vector().normalized(), 5 * random.normal_vector(), heading);
    EXPECT_NEAR(direction.dot(heading), 0, 1e-12);
    EXPECT_NEAR(direction.norm(), 1, 1e-12);
  }
}

TEST(RepulsiveDirection, OfAHeadOnThrowIsUpward) {
  const RepulsiveField field((RepulsiveConfig()));
  EXPECT_TRUE(field.direction(-kForward, {-5, 0, 0}, kForward).isApprox(Vector3d::UnitZ()));
  // Falling at 37 degrees along the line of sight: what is orthogonal to the heading is upward.
  EXPECT_TRUE(
      field.direction(Vector3d(-0.8, 0, -0.6), {-4, 0, -3}, kForward).isApprox(Vector3d::UnitZ()));
  // The fall-back takes over below the set sine of 0.05.
  EXPECT_TRUE(field.direction(Vector3d(-1, -0.049, 0).normalized(), {-5, 0, 0}, kForward)
                  .isApprox(Vector3d::UnitZ()));
  EXPECT_TRUE(field.direction(Vector3d(-1, -0.051, 0).normalized(), {-5, 0, 0}, kForward)
                  .isApprox(-Vector3d::UnitZ()));
}

TEST(RepulsiveDirection, OfASteepHeadOnThrowIsSideways) {
  const RepulsiveField field((RepulsiveConfig()));
  EXPECT_TRUE(
      field.direction(Vector3d(-0.6, 0, -0.8), {-3, 0, -4}, kForward).isApprox(Vector3d::UnitY()));
  EXPECT_TRUE(
      field.direction(-Vector3d::UnitZ(), {0, 0, -4}, kForward).isApprox(Vector3d::UnitY()));
}

// The absolute value of F_z must not turn the escape against the obstacle.
TEST(RepulsiveDirection, OfASteepHeadOnThrowMirrorsAndIsNeverDown) {
  const RepulsiveField field((RepulsiveConfig()));
  Generator random(3);
  for (int k = 0; k < 1000; ++k) {
    const double azimuth = random.uniform(-3.1, 3.1), fall = random.uniform(0.8, 1.5);
    const Vector3d along(-std::cos(azimuth) * std::cos(fall), std::sin(azimuth) * std::cos(fall),
                         -std::sin(fall));
    const Vector3d mirrored_along(along.x(), -along.y(), along.z());
    const Vector3d escape = field.direction(along, 5 * along, kForward);
    const Vector3d mirrored = field.direction(mirrored_along, 5 * mirrored_along, kForward);
    EXPECT_GE(escape.z(), 0);
    EXPECT_TRUE(mirrored.isApprox(Vector3d(0, -escape.y(), escape.z()), 1e-9)) << k;
  }
  // Falling at 60 degrees from the left: to the right and up, across the path.
  const double half = 0.5, high = std::sqrt(0.75);
  EXPECT_TRUE(field.direction(Vector3d(0, -half, -high), {0, -5 * half, -5 * high}, kForward)
                  .isApprox(Vector3d(0, -high, half)));
}

TEST(RepulsiveDirection, IsUpwardWhereSidewaysIsAlongThePath) {
  RepulsiveConfig config;
  config.steep_deg = 0;
  const RepulsiveField field(config);
  for (const Vector3d& along : {Vector3d(0, -1, 0), Vector3d(0.001, -1, 0), Vector3d(0, 1, 0)}) {
    EXPECT_TRUE(field.direction(along, 6 * along, kForward).isApprox(Vector3d::UnitZ(), 1e-3));
  }
}

TEST(RepulsiveDirection, OfAHeadOnThrowFromTheSideIsNotAlongItsPath) {
  const RepulsiveField field((RepulsiveConfig()));
  EXPECT_TRUE(
      field.direction(-Vector3d::UnitY(), {0, -5, 0}, kForward).isApprox(Vector3d::UnitZ()));
  // (29) points along the heading here, so that (30) leaves nothing of it.
  EXPECT_TRUE(field.direction(Vector3d(0, -1, -0.5).normalized(), {0, -5, 0}, kForward)
                  .isApprox(Vector3d::UnitZ()));
}

TEST(RepulsiveDirection, AwayIsTheShortestWayOffTheLineOfFlight) {
  RepulsiveConfig config;
  config.direction = "away";
  const RepulsiveField field(config);
  EXPECT_TRUE(field.direction(Vector3d(-3, -0.3, -0.4).normalized(), {-5, 0, 0}, kForward)
                  .isApprox(Vector3d(0, -0.6, -0.8)));
}

TEST(RepulsiveForce, IsMagnitudeTimesSpeedAlongTheDirection) {
  // Ball's centre at distance 5, its surface at 4.9, eta = 4.75 with the vehicle's radius of 0.15.
  RepulsiveConfig config;
  config.eta_0_m = 10;
  const double magnitude = RepulsiveField(config).magnitude(4.75, 4);
  const Vector3d force = force_of_ball(config, {3, 0, 4}, {-5, 0, 0});
  EXPECT_TRUE(force.isApprox(5 * magnitude * Vector3d::UnitY(), 1e-9));
  config.scale_by_speed = false;
  EXPECT_TRUE(
      force_of_ball(config, {3, 0, 4}, {-5, 0, 0}).isApprox(magnitude * Vector3d::UnitY(), 1e-9));
}

TEST(RepulsiveForce, HasAPositiveVerticalComponentWhereAsked) {
  RepulsiveConfig config;
  config.upward = false;
  // Up and to the left of the line of sight, in the quadrant where (29) points left and down.
  const Vector3d p(2, 0.2, 0.2), v(-5, 0, 0);
  const Vector3d as_is = force_of_ball(config, p, v);
  EXPECT_GT(as_is.y(), 0.1);
  EXPECT_LT(as_is.z(), -0.1);
  config.upward = true;
  EXPECT_TRUE(force_of_ball(config, p, v).isApprox(Vector3d(as_is.x(), as_is.y(), -as_is.z())));
}

TEST(RepulsiveForce, OfAnObstacleThatHasPassedStays) {
  EXPECT_GT(force_of_ball({}, {-1, 0.3, 0}, {-5, 0, 0}).norm(), 1);
}

TEST(RepulsiveForce, OfTheClassicFieldPointsAwayFromTheObstacle) {
  RepulsiveConfig config = config_with(2, "khosla");
  config.direction = "gradient";
  config.scale_by_speed = false;
  const Vector3d force = force_of_ball(config, {0, 1.25, 0}, {0, -5, 0});  // eta = 1
  EXPECT_TRUE(force.isApprox(Vector3d(0, -16.0 / 9, 0), 1e-9));
}

TEST(RepulsiveForce, HasItsMagnitudeAndItsDirectionApart) {
  RepulsiveConfig falanga = config_with(2, "falanga"), khosla = config_with(2, "khosla");
  for (const char* direction : {"cross", "away", "gradient"}) {
    falanga.direction = khosla.direction = direction;
    const auto force = [](const RepulsiveConfig& config) {
      return force_of_ball(config, {0.3, 1.25, 0.2}, {0.5, -5, 1});
    };
    EXPECT_TRUE(force(falanga).normalized().isApprox(force(khosla).normalized(), 1e-9))
        << direction;
    EXPECT_GT(force(falanga).norm(), 1.2 * force(khosla).norm()) << direction;
  }
}

TEST(RepulsiveConfig, RefusesWhatHasNoMeaning) {
  const auto refused = [](auto change) {
    RepulsiveConfig config;
    change(config);
    EXPECT_THROW(check_ranges(config), std::invalid_argument);
  };
  refused([](RepulsiveConfig& c) { c.field = "magnetic"; });
  refused([](RepulsiveConfig& c) { c.direction = ""; });
  refused([](RepulsiveConfig& c) { c.gamma = -1.5; });
  refused([](RepulsiveConfig& c) { c.gamma = std::nan(""); });
  refused([](RepulsiveConfig& c) { c.eta_0_m = 0; });
  refused([](RepulsiveConfig& c) { c.k_tau = 0; });
}

}  // namespace
}  // namespace dodge
