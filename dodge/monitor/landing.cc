#include "dodge/monitor/landing.h"

#include <cmath>

namespace dodge {

void Landing::add(TimeUs t_us, double estimated_m, double measured_m) {
  const double ground_m = estimated_m - measured_m;
  const TimeUs passed_us = last_us_ ? t_us - *last_us_ : 0;
  const double dt_s = seconds(passed_us);
  const double expected_m = ground_m_ + dt_s * drift_mps_;
  const double error_m = ground_m - expected_m;
  if (!last_us_ || passed_us < 0 || passed_us > config_.fresh_us ||
      std::abs(error_m) > config_.max_step_m) {
    ground_m_ = ground_m;  // the drift goes on as it was, also where time has gone back
  } else {
    // Both poles at exp(-dt / tau): critically damped at any rate of readings.
    const double stays = std::exp(-dt_s / config_.drift_filter_s);
    ground_m_ = expected_m + (1 - stays * stays) * error_m;
    if (dt_s > 0) drift_mps_ += (1 - stays) * (1 - stays) / dt_s * error_m;
  }
  last_us_ = t_us;
  height_m_ = measured_m;
}

VelocityCommand Landing::command(TimeUs now_us) const {
  const bool known = last_us_ && now_us - *last_us_ <= config_.fresh_us;
  const bool high = known && height_m_ > config_.slow_below_m;
  VelocityCommand command;
  command.t_us = now_us;
  command.landing = true;
  command.v_W.z() = drift_mps_ - (high ? config_.descent_mps : config_.touchdown_mps);
  return command;
}

}  // namespace dodge
