#include "sim/control/mixer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/base/random.h"
#include "tests/nominal_vehicle.h"

namespace dodgesim {
namespace {

constexpr double kMinN = 0.1;
constexpr double kMaxN = 9.5;
constexpr double kAssuredNm = 0.02;
constexpr double kTolerance = 1e-9;

Mixer nominal_mixer() { return Mixer(nominal_vehicle(), kMinN, kMaxN, kAssuredNm); }

Wrench random_wrench(RandomStream& random, double reach) {
  Wrench wrench;
  wrench.thrust_n = random.uniform(0, 1 + 45 * reach);
  wrench.torque_nm = reach * Eigen::Vector3d(random.uniform(-3, 3), random.uniform(-3, 3),
                                             random.uniform(-.5, .5));
  return wrench;
}

bool feasible(const Mixer& mixer, const Wrench& wanted) {
  const Wrench got = mixer.wrench(mixer.rotor_thrusts(wanted));
  return std::abs(got.thrust_n - wanted.thrust_n) < kTolerance &&
         (got.torque_nm - wanted.torque_nm).norm() < kTolerance;
}

TEST(Mixer, HoverSharesTheWeightEqually) {
  for (double thrust_n : nominal_mixer().rotor_thrusts({9.81, Eigen::Vector3d::Zero()})) {
    EXPECT_NEAR(thrust_n, 9.81 / 4, 1e-12);
  }
}

// Rotor i at p_i: torque about x is +p_y f, about y is -p_x f, about z is spin kappa f.
TEST(Mixer, TorquesRaiseTheRotorsOnTheirSide) {
  const Mixer mixer = nominal_mixer();
  const std::array<double, 4> roll = mixer.rotor_thrusts({12, {0.2, 0, 0}});
  const std::array<double, 4> pitch = mixer.rotor_thrusts({12, {0, 0.17, 0}});
  const std::array<double, 4> yaw = mixer.rotor_thrusts({12, {0, 0, 0.024}});
  const double by_roll = 0.2 / (4 * 0.10);
  const double by_pitch = 0.17 / (4 * 0.085);
  const double by_yaw = 0.024 / (4 * 0.012);
  const VehicleParameters vehicle = nominal_vehicle();
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(roll[i], 3 + std::copysign(by_roll, vehicle.rotor_p_B[i].y()), 1e-12);
    EXPECT_NEAR(pitch[i], 3 - std::copysign(by_pitch, vehicle.rotor_p_B[i].x()), 1e-12);
    EXPECT_NEAR(yaw[i], 3 + vehicle.rotor_spin[i] * by_yaw, 1e-12);
  }
}

TEST(Mixer, FeasibleWrenchesComeOutAsAsked) {
  const Mixer mixer = nominal_mixer();
  RandomStream random(1, 0, "test");
  for (int n = 0; n < 2000; ++n) {
    std::array<double, 4> rotors;
    for (double& thrust_n : rotors) thrust_n = random.uniform(kMinN, kMaxN);
    const std::array<double, 4> again = mixer.rotor_thrusts(mixer.wrench(rotors));
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(again[i], rotors[i], kTolerance);
  }
}

TEST(Mixer, LimitsHoldForAnyWrench) {
  const Mixer mixer = nominal_mixer();
  RandomStream random(2, 0, "test");
  for (int n = 0; n < 20000; ++n) {
    for (double thrust_n : mixer.rotor_thrusts(random_wrench(random, 10))) {
      EXPECT_GE(thrust_n, kMinN);
      EXPECT_LE(thrust_n, kMaxN);
    }
  }
}

TEST(Mixer, RollAndPitchKeepTheirAxis) {
  const Mixer mixer = nominal_mixer();
  RandomStream random(3, 0, "test");
  for (int n = 0; n < 5000; ++n) {
    const Wrench wanted = random_wrench(random, 3);
    const Eigen::Vector2d rp = wanted.torque_nm.head<2>();
    const Eigen::Vector2d got = mixer.wrench(mixer.rotor_thrusts(wanted)).torque_nm.head<2>();
    EXPECT_NEAR(got.x() * rp.y() - got.y() * rp.x(), 0, 1e-8);
    EXPECT_GE(got.dot(rp), -kTolerance);
    EXPECT_LE(got.norm(), rp.norm() + kTolerance);
  }
}

// Whether `wanted`, or the same with less yaw torque (down to the assured amount), is feasible at
// its collective thrust or, if `any_thrust`, at any other.
bool feasible_with_less_yaw(const Mixer& mixer, Wrench wanted, bool any_thrust) {
  const double yaw_nm = wanted.torque_nm.z();
  const double least = std::min(kAssuredNm, std::abs(yaw_nm));
  for (double share = 0; share <= 1; share += 0.25) {
    wanted.torque_nm.z() = std::copysign(least + share * (std::abs(yaw_nm) - least), yaw_nm);
    if (!any_thrust && feasible(mixer, wanted)) return true;
    for (double thrust_n = 0; any_thrust && thrust_n < 40; thrust_n += 0.2) {
      wanted.thrust_n = thrust_n;
      if (feasible(mixer, wanted)) return true;
    }
  }
  return false;
}

// By perturbation: a little more of what was lost is not possible, not even for less of what
// matters less.
TEST(Mixer, YawGivesWayBeforeThrustAndThrustBeforeRollAndPitch) {
  const Mixer mixer = nominal_mixer();
  RandomStream random(4, 0, "test");
  int yaw_lost = 0, thrust_lost = 0, roll_pitch_lost = 0;
  for (int n = 0; n < 5000; ++n) {
    const Wrench wanted = random_wrench(random, 0.6);
    const Wrench got = mixer.wrench(mixer.rotor_thrusts(wanted));
    const double assured_nm = std::min(kAssuredNm, std::abs(wanted.torque_nm.z()));
    EXPECT_GE(std::abs(got.torque_nm.z()), assured_nm - kTolerance);
    constexpr double kNudge = 1e-3;
    Wrench better = got;
    if ((got.torque_nm - wanted.torque_nm).head<2>().norm() > kTolerance) {
      ++roll_pitch_lost;
      better.torque_nm.head<2>() *= 1 + kNudge;
      EXPECT_FALSE(feasible_with_less_yaw(mixer, better, true));
    } else if (std::abs(got.thrust_n - wanted.thrust_n) > kNudge) {
      ++thrust_lost;
      better.thrust_n += std::copysign(kNudge, wanted.thrust_n - got.thrust_n);
      EXPECT_FALSE(feasible_with_less_yaw(mixer, better, false));
    } else if (std::abs(got.torque_nm.z() - wanted.torque_nm.z()) > kNudge) {
      ++yaw_lost;
      better.torque_nm.z() += std::copysign(kNudge, wanted.torque_nm.z());
      EXPECT_FALSE(feasible(mixer, better));
    }
  }
  EXPECT_GT(yaw_lost, 200);
  EXPECT_GT(thrust_lost, 200);
  EXPECT_GT(roll_pitch_lost, 200);
}

// However much is assured: the rotors give 2 kappa (max - min) of yaw at most, and half of it then.
TEST(Mixer, YawNeverTakesAllOfRollAndPitch) {
  const VehicleParameters vehicle = nominal_vehicle();
  const double half_nm = vehicle.kappa_m * (kMaxN - kMinN);
  const Wrench wanted{10, {2, 1, 0.4}};
  const Mixer greedy(vehicle, kMinN, kMaxN, 1);
  const Wrench got = greedy.wrench(greedy.rotor_thrusts(wanted));
  EXPECT_NEAR(got.torque_nm.z(), half_nm, kTolerance);
  EXPECT_GT(got.torque_nm.x(), 0.2);
  EXPECT_NEAR(got.torque_nm.x(), 2 * got.torque_nm.y(), kTolerance);
}

TEST(Mixer, MirroredWrenchGivesMirroredRotors) {
  const Mixer mixer = nominal_mixer();
  RandomStream random(5, 0, "test");
  for (int n = 0; n < 2000; ++n) {
    const Wrench left = random_wrench(random, 2);
    Wrench right = left;
    right.torque_nm.x() *= -1;
    right.torque_nm.z() *= -1;
    const std::array<double, 4> a = mixer.rotor_thrusts(left);
    const std::array<double, 4> b = mixer.rotor_thrusts(right);
    EXPECT_NEAR(a[0], b[1], kTolerance);
    EXPECT_NEAR(a[1], b[0], kTolerance);
    EXPECT_NEAR(a[2], b[3], kTolerance);
    EXPECT_NEAR(a[3], b[2], kTolerance);
  }
}

TEST(Mixer, OffCentreRotorsStillGiveTheWrenchAsked) {
  VehicleParameters vehicle = nominal_vehicle();
  vehicle.rotor_p_B[0].x() += 0.02;
  vehicle.rotor_p_B[2].y() -= 0.03;
  const Mixer mixer(vehicle, kMinN, kMaxN, kAssuredNm);
  EXPECT_TRUE(feasible(mixer, {14, {0.1, -0.1, 0.01}}));
  RandomStream random(6, 0, "test");
  for (int n = 0; n < 5000; ++n) {
    const Wrench wanted = random_wrench(random, 1);
    const Eigen::Vector2d rp = wanted.torque_nm.head<2>();
    const Eigen::Vector2d got = mixer.wrench(mixer.rotor_thrusts(wanted)).torque_nm.head<2>();
    EXPECT_NEAR(got.x() * rp.y() - got.y() * rp.x(), 0, 1e-8);
  }
}

TEST(Mixer, RefusesVehiclesItCannotMix) {
  VehicleParameters in_line = nominal_vehicle();
  for (Eigen::Vector3d& p : in_line.rotor_p_B) p.y() = 0;
  EXPECT_THROW(Mixer(in_line, kMinN, kMaxN, kAssuredNm), std::invalid_argument);
  VehicleParameters aside = nominal_vehicle();
  for (Eigen::Vector3d& p : aside.rotor_p_B) p.x() += 0.2;
  EXPECT_THROW(Mixer(aside, kMinN, kMaxN, kAssuredNm), std::invalid_argument);
  EXPECT_THROW(Mixer(nominal_vehicle(), 2, 1, kAssuredNm), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim
