// The refractory period, and the clock of the time stamps.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/time.h"
#include "sim/check/check.h"
#include "sim/events/spec.h"

namespace dodgesim {

struct RampEvents {
  // Between two events of a pixel while the light grows steadily [us].
  std::vector<double> intervals_us;
  // Of each pixel that made an event, the median of its own; infinite if it made no second one.
  std::vector<double> pixel_medians_us;
  double threshold_takes_us = 0;  // what the light takes to grow by the threshold that is set
  double film_us = 0;             // for so long the light of each pixel grows
  // Of the same events with the camera's clock: their stamps since the first picture, and by how
  // much these are later than by a clock of 1 us.
  std::vector<TimeUs> stamps_us;
  std::vector<double> rounded_by_us;
};

RampEvents measure_ramp(const EventCameraSpec& camera, std::uint64_t seed);

Check judge(const RampEvents& measured, const EventCameraSpec& expected);

}  // namespace dodgesim
