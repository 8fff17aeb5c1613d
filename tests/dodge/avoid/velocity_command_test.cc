#include "dodge/avoid/velocity_command.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "dodge/check_ranges.h"

namespace dodge {
namespace {

using Eigen::Vector3d;

TEST(VelocityCommand, IsTheSumOfTheForces) {
  const VelocityCommand command = velocity_command({}, 42, Vector3d(0, 2, 1), Vector3d(1.5, 0, 0));
  EXPECT_TRUE(command.v_W.isApprox(Vector3d(1.5, 2, 1)));
  EXPECT_TRUE(command.evading);
  EXPECT_EQ(command.t_us, 42);
}

TEST(VelocityCommand, KeepsItsDirectionAtTheSpeedLimit) {
  const VelocityCommand command = velocity_command({}, 0, Vector3d(0, 30, 40), Vector3d::Zero());
  EXPECT_TRUE(command.v_W.isApprox(Vector3d(0, 3, 4)));
}

TEST(VelocityCommand, IsNoEvasionWithoutARepulsiveForce) {
  EXPECT_FALSE(velocity_command({}, 0, Vector3d::Zero(), Vector3d(1.5, 0, 0)).evading);
  EXPECT_FALSE(velocity_command({}, 0, Vector3d(0.09, 0, 0), Vector3d::Zero()).evading);
  EXPECT_TRUE(velocity_command({}, 0, Vector3d(0.11, 0, 0), Vector3d::Zero()).evading);
}

TEST(VelocityLimitConfig, RefusesALimitOfZero) {
  EXPECT_THROW(check_ranges(VelocityLimitConfig{0, 0.1}), std::invalid_argument);
  EXPECT_THROW(check_ranges(VelocityLimitConfig{5, -0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace dodge
