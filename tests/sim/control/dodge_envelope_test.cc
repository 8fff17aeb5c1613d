// How fast an object the closed loop can still dodge, against the planar study made before the
// first line was written (m = 1 kg, 9.5 N per motor, object head-on from 3 m, radii together 0.35
// m, 3.5 ms perception, 6.5 ms command delay).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/sim/control/closed_loop.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

constexpr double kDistanceM = 3;
constexpr double kRadiiM = 0.35;
constexpr TimeUs kPerceptionUs = 3500;
constexpr TimeUs kCommandDelayUs = 6500;

// The controller as the stock stack flies it: the command goes through the position loop, nothing
// is fed forward.
FlightSetup stock_setup() {
  FlightSetup setup;
  setup.command_delay_us = kCommandDelayUs;
  setup.controller.velocity_filter_s = 0.8;
  setup.controller.acceleration_feed_forward = false;
  setup.controller.acceleration_limit_mps2 = 10000;
  return setup;
}

// Sideways displacement after each tick when the object appears at t = 0.
std::vector<double> sidestep(const FlightSetup& setup, const VelocityReference& reference) {
  Flight flight(setup);
  std::vector<double> y_m;
  flight.fly(
      1500000,
      [&](const StateReading& state) {
        return state.t_us >= kPerceptionUs ? reference : normal(Vector3d::Zero());
      },
      [&] { y_m.push_back(flight.body.p_W.y()); });
  return y_m;
}

double fastest_dodged_mps(const FlightSetup& setup, const VelocityReference& reference) {
  const std::vector<double> y_m = sidestep(setup, reference);
  double fastest = 0;
  for (double speed = 2; speed < 20; speed += 0.05) {
    double nearest = kDistanceM;
    for (std::size_t i = 0; i < y_m.size(); ++i) {
      const double t_s = seconds(kTickUs) * static_cast<double>(i + 1);
      nearest = std::min(nearest, std::hypot(kDistanceM - speed * t_s, y_m[i]));
    }
    if (nearest >= kRadiiM) fastest = speed;
  }
  return fastest;
}

TEST(DodgeEnvelope, StockVelocityModeCannotDodge) {
  EXPECT_NEAR(fastest_dodged_mps(stock_setup(), normal({0, 3, 0})), 4.3, 0.2 * 4.3);
}

TEST(DodgeEnvelope, DirectCommandWithStockClips) {
  FlightSetup setup = stock_setup();
  setup.controller.velocity_filter_s = 0;
  EXPECT_NEAR(fastest_dodged_mps(setup, normal({0, 3, 0})), 7.5, 0.1 * 7.5);
}

TEST(DodgeEnvelope, DirectCommandWithoutClips) {
  FlightSetup setup = stock_setup();
  setup.controller.velocity_filter_s = 0;
  setup.controller.velocity_clip_xy_mps = 100;
  setup.controller.position_clip_xy_m = 100;
  EXPECT_NEAR(fastest_dodged_mps(setup, normal({0, 5, 0})), 10.8, 0.1 * 10.8);
}

TEST(DodgeEnvelope, TheEvadingModeIsNoWorseThanTheDirectCommandWithoutClips) {
  FlightSetup setup;
  setup.command_delay_us = kCommandDelayUs;
  EXPECT_GT(fastest_dodged_mps(setup, evade({0, 5, 0})), 10.8);
}

struct Sidestep {
  double acceleration_mps2;
  double dead_time_s;
};

// y = a (t - t_dead)^2 / 2 through the first 0.35 m: sqrt(y) is linear in t, least squares.
Sidestep fit_sidestep(const std::vector<double>& y_m) {
  constexpr double kFromM = 0.02;
  double n = 0, st = 0, sr = 0, stt = 0, str = 0;
  for (std::size_t i = 0; i < y_m.size() && y_m[i] < kRadiiM; ++i) {
    if (y_m[i] < kFromM) continue;
    const double t_s = seconds(kTickUs) * static_cast<double>(i + 1);
    const double root = std::sqrt(y_m[i]);
    n += 1;
    st += t_s;
    sr += root;
    stt += t_s * t_s;
    str += t_s * root;
  }
  const double slope = (n * str - st * sr) / (n * stt - st * st);
  return {2 * slope * slope, (st - sr / slope) / n};
}

TEST(DodgeEnvelope, TheSidestepIsADeadTimeFollowedByAConstantAcceleration) {
  FlightSetup stock = stock_setup();
  stock.controller.velocity_filter_s = 0;
  stock.controller.velocity_clip_xy_mps = 100;
  stock.controller.position_clip_xy_m = 100;
  FlightSetup ours;
  ours.command_delay_us = kCommandDelayUs;
  const Sidestep stock_step = fit_sidestep(sidestep(stock, normal({0, 5, 0})));
  const Sidestep our_step = fit_sidestep(sidestep(ours, evade({0, 5, 0})));
  EXPECT_NEAR(stock_step.acceleration_mps2, 20, 0.1 * 20);
  EXPECT_NEAR(stock_step.dead_time_s, 0.090, 0.005);
  EXPECT_GT(our_step.acceleration_mps2, 20);
  EXPECT_NEAR(our_step.dead_time_s, 0.090, 0.005);
}

}  // namespace
}  // namespace dodgesim
