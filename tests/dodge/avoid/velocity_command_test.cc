#include "dodge/avoid/velocity_command.h"

#include <gtest/gtest.h>

#include <algorithm>
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

VelocityCommand wanted(TimeUs t_us, const Vector3d& v_W, bool evading = false) {
  VelocityCommand command;
  command.t_us = t_us;
  command.v_W = v_W;
  command.evading = evading;
  return command;
}

TEST(CommandRamp, BrakesGentlyFromTheVelocityOfAnEscape) {
  CommandRamp ramp({.calm_acceleration_mps2 = 5});
  const Vector3d escape(0, 3, 4), home(-1.5, 0, 0);
  EXPECT_EQ(ramp.ramped(wanted(0, escape, true), Vector3d::Zero()).v_W, escape);
  // The vehicle has reached no more than this when the escape ends; then it goes the straight way.
  const Vector3d reached(0, 1.5, 2), change = home - reached;
  for (int cycle = 1; cycle < 250; ++cycle) {
    const double changed_mps = 5 * 0.004 * (cycle - 1);
    const Vector3d v_W = ramp.ramped(wanted(4000 * cycle, home), reached).v_W;
    const double share = std::min(1.0, changed_mps / change.norm());
    ASSERT_TRUE(v_W.isApprox(reached + share * change, 1e-9)) << cycle;
  }
  EXPECT_EQ(ramp.ramped(wanted(1000000, home), reached).v_W, home);
}

TEST(CommandRamp, HoldsTheCommandWhenTimeGoesBack) {
  CommandRamp ramp({.calm_acceleration_mps2 = 5});
  const Vector3d reached(0, 3, 0);
  ramp.ramped(wanted(100000, {0, 5, 0}, true), Vector3d::Zero());
  ramp.ramped(wanted(200000, Vector3d::Zero()), reached);
  EXPECT_EQ(ramp.ramped(wanted(0, Vector3d::Zero()), reached).v_W, reached);
  EXPECT_LT(ramp.ramped(wanted(100000, Vector3d::Zero()), reached).v_W.y(), 3);
}

TEST(CommandRamp, EndsWhenTheCommandIsWhatIsWanted) {
  CommandRamp ramp({.calm_acceleration_mps2 = 5});
  EXPECT_EQ(ramp.ramped(wanted(0, {1.5, 0, 0}), Vector3d::Zero()).v_W, Vector3d(1.5, 0, 0));
  EXPECT_EQ(ramp.acceleration_mps2(), 0) << "nothing has been evaded";
  ramp.ramped(wanted(4000, {0, 5, 0}, true), Vector3d::Zero());
  ramp.ramped(wanted(8000, {1.5, 0, 0}), {0, 1, 0});
  EXPECT_EQ(ramp.acceleration_mps2(), 5);
  EXPECT_EQ(ramp.ramped(wanted(1000000, {1.5, 0, 0}), {0, 1, 0}).v_W, Vector3d(1.5, 0, 0));
  EXPECT_EQ(ramp.acceleration_mps2(), 0);
  EXPECT_EQ(ramp.ramped(wanted(1004000, Vector3d::Zero()), {1.5, 0, 0}).v_W, Vector3d::Zero());
}

TEST(CommandRamp, BrakesADescentAtOnceAndKeepsTheSpeedLimit) {
  CommandRamp ramp({.max_speed_mps = 5, .calm_acceleration_mps2 = 3});
  ramp.ramped(wanted(0, {0, 5, 0}, true), Vector3d::Zero());
  EXPECT_EQ(ramp.ramped(wanted(4000, Vector3d::Zero()), {0, 4, -1.3}).v_W, Vector3d(0, 4, 0));
  ramp.ramped(wanted(8000, {0, 5, 0}, true), Vector3d::Zero());
  const Vector3d v_W = ramp.ramped(wanted(12000, Vector3d::Zero()), {0, 5.4, 1}).v_W;
  EXPECT_NEAR(v_W.norm(), 5, 1e-12);
}

TEST(CommandRamp, FollowsTheNextEscapeAtOnceToo) {
  CommandRamp ramp({.calm_acceleration_mps2 = 5});
  const Vector3d first(0, 5, 0), second(0, 0, 5), slow(0, 0, 1);
  ramp.ramped(wanted(0, first, true), Vector3d::Zero());
  ramp.ramped(wanted(4000, Vector3d::Zero()), first);
  EXPECT_EQ(ramp.ramped(wanted(8000, second, true), first).v_W, second);
  EXPECT_EQ(ramp.ramped(wanted(12000, Vector3d::Zero()), slow).v_W, slow);
}

TEST(CommandRamp, IsOffInThePapersPilot) {
  CommandRamp ramp({});
  ramp.ramped(wanted(0, {0, 5, 0}, true), Vector3d::Zero());
  EXPECT_EQ(ramp.ramped(wanted(4000, {1, 0, 0}), {0, 5, 0}).v_W, Vector3d(1, 0, 0));
}

TEST(VelocityLimitConfig, RefusesALimitOfZero) {
  EXPECT_THROW(check_ranges(VelocityLimitConfig{.max_speed_mps = 0}), std::invalid_argument);
  EXPECT_THROW(check_ranges(VelocityLimitConfig{.evading_threshold_mps = -0.1}),
               std::invalid_argument);
}

}  // namespace
}  // namespace dodge
