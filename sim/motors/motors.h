// Speed controllers and rotors: from thrust commands to thrusts.
#pragma once

#include <array>
#include <vector>

#include "sim/base/time.h"

namespace dodgesim {

struct MotorSpec {
  double time_constant_up_s = 0.04;
  double time_constant_down_s = 0.04;
  int esc_delay_us = 50;
  double min_thrust_n = 0.1;

  template <class Visitor>
  void visit(Visitor& v) {
    v("time_constant_up_s", time_constant_up_s, 0.001, 1,
      "Lag of a rotor's thrust when it rises; 0.04 s is the nominal vehicle's on 4 cells (its "
      "drive with two-bladed propellers on 3 cells measured 0.048 s).");
    v("time_constant_down_s", time_constant_down_s, 0.001, 1,
      "Lag of a rotor's thrust when it falls; as rising, because the speed controllers brake "
      "actively (0.061 s was measured on 3 cells).");
    v("esc_delay_us", esc_delay_us, 0, 20000,
      "Time from the flight controller's output to the motor's reaction: one DShot frame.");
    v("min_thrust_n", min_thrust_n, 0, 5,
      "Thrust of an idling rotor; rotors never stop in flight.");
  }
};

// Four rotors with a first-order lag from commanded to produced thrust. The lag acts on thrust and
// not on rotor speed because it was identified so, on a load cell, and because the body-rate
// control of that platform models it so. Discretisation is exact for any command history: commands
// take effect at their own instant, also inside a tick.
class Motors {
 public:
  // max_thrust_n: of one rotor. Throws std::invalid_argument if it is not above min_thrust_n.
  Motors(const MotorSpec& spec, double max_thrust_n);

  // Rotors turn steadily at these thrusts from t_us on; commands under way are forgotten.
  void reset(TimeUs t_us, const std::array<double, 4>& thrust_n);

  // A command leaves the flight controller at t_us (not before the last one) and acts
  // esc_delay_us later, limited to [min_thrust_n, max_thrust_n].
  void set_command(TimeUs t_us, const std::array<double, 4>& thrust_n);

  // Thrusts at t_us [N], not before the last call's instant. Commands given later than
  // t_us - esc_delay_us have no effect yet.
  const std::array<double, 4>& step(TimeUs t_us);

 private:
  struct Command {
    TimeUs acts_us;
    std::array<double, 4> thrust_n;
  };

  void advance(TimeUs t_us);

  MotorSpec spec_;
  double max_thrust_n_;
  TimeUs t_us_ = 0;
  std::array<double, 4> thrust_n_{};
  std::array<double, 4> command_n_{};
  std::vector<Command> under_way_;  // in the order in which they act
};

}  // namespace dodgesim
