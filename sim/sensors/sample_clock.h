// A sensor's rate as a whole number of physics ticks.
#pragma once

#include <string>

#include "sim/base/error.h"
#include "sim/base/time.h"

namespace dodgesim {

class SampleClock {
 public:
  // Throws ScenarioError unless rate_hz > 0 divides the tick rate of 4000 Hz.
  SampleClock(int rate_hz, const std::string& sensor) {
    constexpr int kTickRateHz = static_cast<int>(1000000 / kTickUs);
    if (rate_hz <= 0 || kTickRateHz % rate_hz != 0) {
      throw ScenarioError("The rate of the " + sensor + " is " + std::to_string(rate_hz) +
                          " Hz, but it must divide " + std::to_string(kTickRateHz) + " Hz.");
    }
    period_us_ = 1000000 / rate_hz;
  }

  TimeUs period_us() const { return period_us_; }
  bool due(TimeUs t_us) const { return t_us % period_us_ == 0; }

 private:
  TimeUs period_us_ = 0;
};

}  // namespace dodgesim
