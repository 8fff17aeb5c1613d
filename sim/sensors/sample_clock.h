// A sensor's rate as a whole number of physics ticks.
#pragma once

#include <string>

#include "sim/base/error.h"
#include "sim/base/time.h"

namespace dodgesim {

class SampleClock {
 public:
  static constexpr int kTickRateHz = static_cast<int>(1000000 / kTickUs);
  static bool fits(int rate_hz) { return rate_hz > 0 && kTickRateHz % rate_hz == 0; }

  // Throws ScenarioError unless the rate fits, that is, divides kTickRateHz.
  SampleClock(int rate_hz, const std::string& sensor) {
    if (!fits(rate_hz)) {
      throw ScenarioError("The rate of the " + sensor + " is " + std::to_string(rate_hz) +
                          " Hz, but it must divide " + std::to_string(kTickRateHz) + " Hz.");
    }
    period_us_ = 1000000 / rate_hz;
  }

  bool due(TimeUs t_us) const { return t_us % period_us_ == 0; }

  // Since the last call; 0 at the first.
  double step_s(TimeUs now_us) {
    const double step_s = last_us_ < 0 ? 0 : seconds(now_us - last_us_);
    last_us_ = now_us;
    return step_s;
  }

 private:
  TimeUs period_us_ = 0;
  TimeUs last_us_ = -1;
};

}  // namespace dodgesim
