// How late and how spread the pixels answer to a step of the light.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/check/check.h"
#include "sim/events/spec.h"

namespace dodgesim {

struct LightStep {
  double before_lux = 0;
  double after_lux = 0;  // twice or half as much

  bool up() const { return after_lux > before_lux; }
};

struct StepAnswer {
  LightStep step;
  std::vector<double> latencies_us = {};  // of the first events of the pixels that fired
};

std::vector<StepAnswer> measure_step_response(const EventCameraSpec& camera, std::uint64_t seed);

Check judge(const std::vector<StepAnswer>& answers, const EventCameraSpec& expected);

// The time [s] after a step of 1 at which low-passes with cut-offs a and b [rad/s] reach `share` of
// it; not positive cut-offs: there is none. Infinite for a share of 1 and more.
double step_time_s(double share, double a_rad_s, double b_rad_s);

}  // namespace dodgesim
