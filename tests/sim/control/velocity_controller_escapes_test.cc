// How the vehicle flies an escape and comes to rest after it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/control/velocity_controller.h"
#include "tests/sim/control/closed_loop.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

// An evasion of 5 m/s for 0.3 s: the height is kept, and afterwards the position loop closes again
// where the vehicle is, without pulling it back to where it was.
TEST(VelocityControllerEscapes, EvadesKeepingHeightAndReengagesWhereItIs) {
  FlightSetup setup;
  setup.command_delay_us = 6500;
  Flight flight(setup);
  constexpr TimeUs kEvasionUs = 300000;
  double height = 0, backwards = 0, y_end = 0;
  flight.fly(
      4 * kSecondUs,
      [&](const StateReading& state) {
        return state.t_us < kEvasionUs ? evade({0, 5, 0}) : normal(Vector3d::Zero());
      },
      [&] {
        height = std::max(height, std::abs(flight.body.p_W.z()));
        backwards = std::min(backwards, flight.body.v_W.y());
        if (flight.t_us < kEvasionUs) y_end = flight.body.p_W.y();
      });
  EXPECT_GT(y_end, 0.35);
  EXPECT_LT(height, 0.12);
  EXPECT_GT(backwards, -1.5);
  EXPECT_LT(flight.body.v_W.norm(), 0.02);
  EXPECT_LT(flight.body.p_W.y(), y_end + 2);
}

// How the vehicle comes to rest after an escape that climbs.
struct LevellingOut {
  double climbed_m = 0;           // beyond what the least thrust cannot brake
  double fastest_turn_radps = 0;  // roll and pitch, from 0.3 s after it on
};

LevellingOut level_out(const ControllerSpec& controller, const Vector3d& escape_W) {
  constexpr TimeUs kEndUs = 600000;
  FlightSetup setup;
  setup.controller = controller;
  setup.command_delay_us = 3250;
  setup.state_error = StateEstimateSpec();
  Flight flight(setup);
  const auto pilot = [&](const StateReading& state) {
    return state.t_us < kEndUs ? evade(escape_W) : normal(Vector3d::Zero());
  };
  flight.fly(kEndUs, pilot);
  const double from_m = flight.body.p_W.z(), climb_mps = flight.body.v_W.z();
  EXPECT_GT(climb_mps, 2);
  LevellingOut out{0, 0};
  flight.fly(2 * kEndUs + 900000, pilot, [&] {
    out.climbed_m = std::max(out.climbed_m, flight.body.p_W.z() - from_m);
    if (flight.t_us < kEndUs + 300000) return;
    out.fastest_turn_radps = std::max(out.fastest_turn_radps, flight.body.w_B.head<2>().norm());
  });
  // What the least thrust leaves of gravity brakes the climb.
  const double brake_mps2 = kGravityMps2 - controller.min_thrust_mps2;
  out.climbed_m -= climb_mps * climb_mps / (2 * brake_mps2);
  return out;
}

TEST(VelocityControllerEscapes, LevelsOutAfterAnEscapeThatClimbs) {
  for (const Vector3d& escape_W : {Vector3d(0, 2, 4.5), Vector3d(-1, -3, 4), Vector3d(2, 0, 4.5)}) {
    const LevellingOut out = level_out({}, escape_W);
    EXPECT_LT(out.climbed_m, 1) << escape_W.transpose();
    EXPECT_LT(out.fastest_turn_radps, 5) << escape_W.transpose();
  }
  ControllerSpec coupled;
  coupled.min_tilt_lift_mps2 = 0;
  EXPECT_GT(level_out(coupled, {0, 2, 4.5}).fastest_turn_radps, 8);
}

TEST(VelocityControllerEscapes, MirroredCommandsGiveMirroredFlights) {
  Flight left{FlightSetup()};
  Flight right{FlightSetup()};
  const auto command = [](double side) {
    return [side](const StateReading& state) {
      const Vector3d v_W(1, 4 * side, 0.5);
      return state.t_us < 400000 ? evade(v_W) : normal(0.3 * v_W);
    };
  };
  left.fly(kSecondUs, command(1));
  right.fly(kSecondUs, command(-1));
  const Vector3d mirror(1, -1, 1);
  EXPECT_LT((left.body.p_W - mirror.cwiseProduct(right.body.p_W)).norm(), 1e-6);
  EXPECT_LT((left.body.v_W - mirror.cwiseProduct(right.body.v_W)).norm(), 1e-6);
}

TEST(VelocityControllerEscapes, HoldsTheHeadingItStartedWithWhileEvadingAnywhere) {
  for (double yaw : {0.0, 1.0, -2.5}) {
    for (double bearing = 0; bearing < 6.2; bearing += 0.7) {
      FlightSetup setup;
      setup.command_delay_us = 6500;
      Flight flight(setup);
      flight.body.q_W = Eigen::AngleAxisd(yaw, Vector3d::UnitZ());
      double worst = 0;
      flight.fly(
          700000,
          [&](const StateReading& state) {
            const Vector3d v_W(5 * std::cos(bearing), 5 * std::sin(bearing), 0);
            return state.t_us < 350000 ? evade(v_W) : normal(Vector3d::Zero());
          },
          [&] {
            worst = std::max(
                worst, std::abs(std::remainder(flight.body.yaw_rad() - yaw, 2 * std::numbers::pi)));
          });
      // Heading of x_B projected on the ground; at 75 deg of tilt it is ill-conditioned.
      EXPECT_LT(worst, 0.6) << "yaw " << yaw << " bearing " << bearing;
      EXPECT_LT(std::abs(std::remainder(flight.body.yaw_rad() - yaw, 2 * std::numbers::pi)), 0.1);
    }
  }
}

// The controller must hold over the spread of the real vehicle's unknown mass and motors.
TEST(VelocityControllerEscapes, StaysStableForHeavierWeakerAndSlowerVehicles) {
  for (double mass_kg : {0.85, 1.2}) {
    for (double lag_s : {0.03, 0.06}) {
      for (double inertia : {0.75, 1.25}) {
        FlightSetup setup;
        setup.command_delay_us = 6500;
        setup.motors.time_constant_up_s = setup.motors.time_constant_down_s = lag_s;
        Flight nominal(setup);
        VehicleParameters actual = nominal_vehicle();
        actual.mass_kg = mass_kg;
        actual.inertia_kgm2 *= inertia;
        nominal.body = RigidBody(actual);
        double late = 0;
        nominal.fly(
            6 * kSecondUs,
            [](const StateReading& state) {
              return state.t_us < 300000 ? evade({3, 4, 0}) : normal(Vector3d::Zero());
            },
            [&] {
              if (nominal.t_us > 4 * kSecondUs) {
                late = std::max(late, nominal.body.w_B.norm());
              }
            });
        EXPECT_LT(late, 0.05) << mass_kg << " kg, lag " << lag_s << ", inertia " << inertia;
      }
    }
  }
}

}  // namespace
}  // namespace dodgesim
