#include "sim/motors/motors.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dodgesim {

Motors::Motors(const MotorSpec& spec, double max_thrust_n)
    : spec_(spec), max_thrust_n_(max_thrust_n) {
  if (!(max_thrust_n > spec.min_thrust_n)) {
    throw std::invalid_argument("A rotor's greatest thrust must exceed motors.min_thrust_n.");
  }
  under_way_.reserve(static_cast<std::size_t>(spec.esc_delay_us / kTickUs) + 2);
  reset(0, {});
}

void Motors::reset(TimeUs t_us, const std::array<double, 4>& thrust_n) {
  t_us_ = t_us;
  for (std::size_t i = 0; i < thrust_n.size(); ++i) {
    thrust_n_[i] = std::clamp(thrust_n[i], spec_.min_thrust_n, max_thrust_n_);
  }
  command_n_ = thrust_n_;
  under_way_.clear();
}

void Motors::set_command(TimeUs t_us, const std::array<double, 4>& thrust_n) {
  Command command{t_us + spec_.esc_delay_us, thrust_n};
  for (double& thrust : command.thrust_n) {
    thrust = std::clamp(thrust, spec_.min_thrust_n, max_thrust_n_);
  }
  under_way_.push_back(command);
}

const std::array<double, 4>& Motors::step(TimeUs t_us) {
  auto next = under_way_.begin();
  for (; next != under_way_.end() && next->acts_us <= t_us; ++next) {
    advance(std::max(next->acts_us, t_us_));
    command_n_ = next->thrust_n;
  }
  under_way_.erase(under_way_.begin(), next);
  advance(t_us);
  return thrust_n_;
}

void Motors::advance(TimeUs t_us) {
  const double dt_s = seconds(t_us - t_us_);
  const double stays_up = std::exp(-dt_s / spec_.time_constant_up_s);
  const double stays_down = std::exp(-dt_s / spec_.time_constant_down_s);
  for (std::size_t i = 0; i < thrust_n_.size(); ++i) {
    const double stays = command_n_[i] > thrust_n_[i] ? stays_up : stays_down;
    thrust_n_[i] = command_n_[i] + (thrust_n_[i] - command_n_[i]) * stays;
  }
  t_us_ = t_us;
}

}  // namespace dodgesim
