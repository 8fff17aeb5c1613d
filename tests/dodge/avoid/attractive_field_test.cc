#include "dodge/avoid/attractive_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "dodge/check_ranges.h"

namespace dodge {
namespace {

using Eigen::Vector3d;

TEST(AttractiveVelocity, IsTheDesiredSpeedBeyondTheCrossover) {
  const AttractiveConfig config;  // e_0 = 0.2 m, gamma_a = 2
  EXPECT_TRUE(attractive_velocity(config, 1.5, {3, 0, 4}).isApprox(Vector3d(0.9, 0, 1.2)));
  EXPECT_TRUE(attractive_velocity(config, 1.5, {0, 0.2, 0}).isApprox(Vector3d(0, 1.5, 0)));
}

TEST(AttractiveVelocity, FallsToZeroAtTheGoal) {
  const AttractiveConfig config;
  EXPECT_TRUE(attractive_velocity(config, 1.5, {0.1, 0, 0}).isApprox(Vector3d(0.375, 0, 0)));
  EXPECT_EQ(attractive_velocity(config, 1.5, Vector3d::Zero()), Vector3d::Zero());
  EXPECT_TRUE(attractive_velocity(config, 1.5, {1e-300, 0, 0}).allFinite());
  EXPECT_NEAR(attractive_velocity(config, 1.5, {0.2 - 1e-9, 0, 0}).x(), 1.5, 1e-6);
}

TEST(AttractiveVelocity, HasAConstantMagnitudeForAnExponentOfZero) {
  const AttractiveConfig config{0.2, 0.0};
  EXPECT_TRUE(attractive_velocity(config, 1.5, {0, 1e-3, 0}).isApprox(Vector3d(0, 1.5, 0)));
  EXPECT_EQ(attractive_velocity(config, 1.5, Vector3d::Zero()), Vector3d::Zero());
}

// Potential (35). As printed it jumps at e_0; the inner branch is raised by k_a e_0 gamma_a /
// (gamma_a + 1), which leaves (36) as it is.
double attractive_potential(const AttractiveConfig& config, double k_a, const Vector3d& e) {
  const double distance = e.norm(), e_0 = config.e_0_m, gamma_a = config.gamma_a;
  if (distance >= e_0) return k_a * distance;
  const double inner = e_0 / (gamma_a + 1) * std::pow(distance / e_0, gamma_a + 1);
  return k_a * (inner + e_0 * gamma_a / (gamma_a + 1));
}

TEST(AttractivePotential, IsContinuousAtTheCrossover) {
  const AttractiveConfig config;
  EXPECT_NEAR(attractive_potential(config, 1.5, {0.2, 0, 0}), 0.3, 1e-12);
  EXPECT_NEAR(attractive_potential(config, 1.5, {0.2 - 1e-12, 0, 0}), 0.3, 1e-9);
}

TEST(AttractivePotential, HasTheVelocityAsItsSlope) {
  const AttractiveConfig config;
  for (const double distance : {0.01, 0.1, 0.199, 0.201, 0.5, 3.0}) {
    const Vector3d e = distance * Vector3d(2, -1, 2) / 3, step = 1e-6 * Vector3d(2, -1, 2) / 3;
    const double slope = (attractive_potential(config, 1.5, e + step) -
                          attractive_potential(config, 1.5, e - step)) /
                         2e-6;
    EXPECT_NEAR(attractive_velocity(config, 1.5, e).norm(), slope, 1e-6) << distance;
  }
}

TEST(AttractiveConfig, RefusesANegativeCrossoverOrExponent) {
  EXPECT_THROW(check_ranges(AttractiveConfig{0, 2}), std::invalid_argument);
  EXPECT_THROW(check_ranges(AttractiveConfig{0.2, -1}), std::invalid_argument);
  EXPECT_THROW(check_ranges(AttractiveConfig{std::nan(""), 2}), std::invalid_argument);
}

}  // namespace
}  // namespace dodge
