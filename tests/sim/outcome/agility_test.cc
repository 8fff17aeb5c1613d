#include "sim/outcome/agility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace dodgesim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr double kPi = std::numbers::pi;

// About the nominal vehicle: 4 x 9.5 N on 1 kg.
const Agility kNominalAgility{38, 404, 0.04, 0.001};

const Vector3d kLeftward = Vector3d::UnitY(), kUpward = Vector3d::UnitZ();

// What a quantity has gained after t_s that grows with a first-order lag to a second derivative
// of 1.
double lagged(double t_s, double lag_s) {
  return 0.5 * t_s * t_s - lag_s * t_s + lag_s * lag_s * (1 - std::exp(-t_s / lag_s));
}

// A ball of 20 cm flies at the middle of a flat box, head-on, and touches it.
Encounter head_on_box(double speed_mps = 6) {
  Encounter encounter;
  encounter.object.p_W = {0.27, 0, 0};
  encounter.object.v_W = {-speed_mps, 0, 0};
  encounter.hull = {Convex::box(Isometry3d::Identity(), {0.17, 0.17, 0.05})};
  encounter.shape = {Convex::sphere(Vector3d::Zero(), 0.1)};
  return encounter;
}

TEST(ManoeuvrePath, StraightUpFollowsTheLagOfTheRotors) {
  const ManoeuvrePath path(kNominalAgility, {0, 0, 1}, 0.3);
  for (const double t_s : {0.0, 0.001, 0.02, 0.1, 0.3}) {
    const double z_m = (38 - kGravity) * lagged(std::max(0.0, t_s - 0.001), 0.04);
    EXPECT_NEAR(path.at(t_s).translation().z(), z_m, 4e-4 * t_s + 1e-6) << t_s;
    EXPECT_TRUE(path.at(t_s).linear().isIdentity(1e-12));
  }
}

TEST(ManoeuvrePath, WithoutThrustTheVehicleEndsInFreeFall) {
  const ManoeuvrePath path(kNominalAgility, {0, 0, 0}, 0.3);
  EXPECT_NEAR(path.at(0.3).translation().z(), -kGravity * lagged(0.299, 0.04), 1e-4);
}

TEST(ManoeuvrePath, TiltsTowardsTheAzimuthAsFastAsTheTorqueAllowsAndStops) {
  const double azimuth = 0.7, tilt = kPi / 3;
  const ManoeuvrePath path(kNominalAgility, {azimuth, tilt, 1}, 0.3);
  const Vector3d early = path.at(0.05).linear() * kUpward, late = path.at(0.3).linear() * kUpward;
  EXPECT_NEAR(std::acos(early.z()), 404 * lagged(0.049, 0.04), 1e-9);
  EXPECT_NEAR(std::acos(late.z()), tilt, 1e-12);
  EXPECT_NEAR(std::atan2(early.y(), early.x()), azimuth, 1e-12);
  const Vector3d p = path.at(0.3).translation();
  EXPECT_NEAR(std::atan2(p.y(), p.x()), azimuth, 1e-12);
  // At the most it could be pushed by all its thrust from the start on.
  EXPECT_LT(p.head<2>().norm(), 0.5 * 38 * 0.3 * 0.3 * std::sin(tilt));
  EXPECT_GT(p.head<2>().norm(), 0.5 * 38 * 0.2 * 0.2 * std::sin(tilt));
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
  motors.time_constant_down_s = 0.06;
  motors.esc_delay_us = 1000;
  const Agility agility = agility_of(vehicle, motors);
  EXPECT_DOUBLE_EQ(agility.max_thrust_mps2, 20);
  EXPECT_DOUBLE_EQ(agility.tilt_acceleration_radps2, 2 * 10 * 0.2 / 0.01);
  EXPECT_DOUBLE_EQ(agility.lag_s, 0.05);
  EXPECT_DOUBLE_EQ(agility.delay_s, 0.001);
}

TEST(Passes, TakesHullAndObjectAsTheyAre) {
  const Encounter fast = head_on_box(50);  // it hardly falls
  EXPECT_FALSE(passes(fast, Vector3d::Zero()));
  EXPECT_FALSE(passes(fast, 0.145 * kUpward));
  EXPECT_TRUE(passes(fast, 0.155 * kUpward));
  EXPECT_FALSE(passes(fast, 0.265 * kLeftward));
  EXPECT_TRUE(passes(fast, 0.275 * kLeftward));
  // Past the edge of the box: further than either alone, less than a square of both.
  EXPECT_FALSE(passes(fast, {0, 0.17 + 0.06, 0.05 + 0.06}));
  EXPECT_TRUE(passes(fast, {0, 0.17 + 0.08, 0.05 + 0.08}));
  // Along the flight only the time of the contact changes.
  EXPECT_FALSE(passes(fast, -0.3 * Vector3d::UnitX()));
}

TEST(Passes, AnObjectThatTurnsComesWithAnotherSide) {
  Encounter rod = head_on_box(6);
  rod.shape = {Convex::box(Isometry3d::Identity(), {0.02, 0.02, 0.3})};
  rod.object.p_W.x() = 0.19;
  EXPECT_FALSE(passes(rod, 0.3 * kUpward));  // upright
  rod.object.q_W = Eigen::AngleAxisd(kPi / 2, Vector3d::UnitX());
  EXPECT_TRUE(passes(rod, 0.3 * kUpward));  // level
  rod.object.w_W.x() = 30;  // upright 0.05 s after the contact, still over the vehicle
  EXPECT_FALSE(passes(rod, 0.3 * kUpward));
}

constexpr double kSumOfRadii = 0.3;

Encounter two_balls(const Vector3d& offset, const Vector3d& v) {
  Encounter encounter;
  encounter.object.p_W = offset;
  encounter.object.v_W = v;
  encounter.hull = {Convex::sphere(Vector3d::Zero(), 0.2)};
  encounter.shape = {Convex::sphere(Vector3d::Zero(), kSumOfRadii - 0.2)};
  return encounter;
}

// By a second, slower reckoning: two balls, times and places in fine steps.
bool balls_pass(const ManoeuvrePath& path, double left_s, const Vector3d& offset, const Vector3d& v,
                double sum_of_radii) {
  constexpr double kAroundS = 0.15;
  for (double t_s = -std::min(left_s, kAroundS); t_s < kAroundS; t_s += 5e-4) {
    const Vector3d object = offset + t_s * v - 0.5 * kGravity * t_s * t_s * kUpward;
    if ((object - path.at(left_s + t_s).translation()).norm() < sum_of_radii) return false;
  }
  return true;
}

// Every manoeuvre of a finer set at every time, shorter than `most_s`.
double least_time_of_balls(const Vector3d& offset, const Vector3d& v, double sum_of_radii,
                           double most_s) {
  double least_s = most_s;
  for (const double thrust_share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
    for (int tilt_deg = 0; tilt_deg <= 180; tilt_deg += 15) {
      for (int i = 0; i < (tilt_deg == 0 ? 1 : 20); ++i) {
        const ManoeuvrePath path(kNominalAgility,
                                 {2 * kPi * i / 20, tilt_deg * kPi / 180, thrust_share}, 0.5);
        for (double left_s = 0; left_s < least_s; left_s += 2e-3) {
          if (balls_pass(path, left_s, offset, v, sum_of_radii)) least_s = left_s;
        }
      }
    }
  }
  return least_s;
}

TEST(LeastTimeToEscape, IsNearlyThatOfAFinerSetOfManoeuvres) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 4; ++n) {
    const Vector3d v = 8 * Vector3d(-1, 0.3 * unit(random), 0.5 * unit(random));
    const Vector3d away = -v.normalized() + 0.6 * Vector3d(0, unit(random), unit(random));
    const Vector3d offset = kSumOfRadii * away.normalized();
    const double least_s = *least_time_to_escape_s(kNominalAgility, two_balls(offset, v));
    const double finer_s = least_time_of_balls(offset, v, kSumOfRadii, least_s + 0.01);
    EXPECT_GT(finer_s, least_s - 0.012) << n;
    EXPECT_LT(finer_s, least_s + 0.005) << n;
  }
}

TEST(LeastTimeToEscape, DownwardTheRotorsHelpToFall) {
  const Encounter above = two_balls({0.29, 0, 0.08}, {-8, 0, -1});
  const ManoeuvrePath drop(kNominalAgility, {0, 0, 0}, 0.6);
  double drop_s = 0;
  while (!balls_pass(drop, drop_s, above.object.p_W, above.object.v_W, kSumOfRadii)) drop_s += 1e-3;
  ASSERT_LT(drop_s, 0.4);
  EXPECT_LT(*least_time_to_escape_s(kNominalAgility, above, -kUpward), drop_s - 0.01);
}

TEST(LeastTimeToEscape, AFlatVehicleGetsAwayFastestUpward) {
  const Encounter encounter = head_on_box(20);
  const double least_s = *least_time_to_escape_s(kNominalAgility, encounter);
  EXPECT_EQ(least_time_to_escape_s(kNominalAgility, encounter, kUpward), least_s);
  EXPECT_GT(*least_time_to_escape_s(kNominalAgility, encounter, kLeftward), least_s + 0.02);
  // The last 15 cm are reached while the ball is over the vehicle, 5 to 22 ms after the contact.
  double rise_s = 0;
  while ((38 - kGravity) * lagged(rise_s, 0.04) < 0.15) rise_s += 1e-4;
  EXPECT_LT(least_s, rise_s);
  EXPECT_GT(least_s, rise_s - 0.022);
}

TEST(LeastTimeToEscape, AnObjectAsideIsSoonerEscapedToTheOtherSide) {
  Encounter encounter = head_on_box();
  encounter.object.p_W.y() = 0.1;
  const double left_s = *least_time_to_escape_s(kNominalAgility, encounter, kLeftward);
  const double right_s = *least_time_to_escape_s(kNominalAgility, encounter, -kLeftward);
  EXPECT_GT(left_s, right_s + 0.02);
}

TEST(LeastTimeToEscape, OnlyTheWayAcrossTheFlightCounts) {
  const Encounter encounter = head_on_box();
  EXPECT_FALSE(least_time_to_escape_s(kNominalAgility, encounter, Vector3d(-5, 0, 0)));
  EXPECT_EQ(least_time_to_escape_s(kNominalAgility, encounter, Vector3d(-5, 0, 1)),
            least_time_to_escape_s(kNominalAgility, encounter, kUpward));
}

TEST(LeastTimeToEscape, StrongerRotorsNeedLess) {
  Agility strong = kNominalAgility;
  strong.max_thrust_mps2 *= 2;
  EXPECT_LT(*least_time_to_escape_s(strong, head_on_box()),
            *least_time_to_escape_s(kNominalAgility, head_on_box()) - 0.01);
}

TEST(LeastTimeToEscape, IsEmptyForRotorsThatHardlyLift) {
  const Agility weak{kGravity + 0.01, 1e-3, 10, 0.9};
  EXPECT_FALSE(least_time_to_escape_s(weak, head_on_box()));
}

}  // namespace
}  // namespace dodgesim
