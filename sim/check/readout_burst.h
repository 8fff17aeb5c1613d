// What the readout does when all pixels fire at once.
#pragma once

#include <cstdint>

#include "sim/check/check.h"
#include "sim/events/spec.h"

namespace dodgesim {

struct Burst {
  bool filmed = false;     // false: the readout has no limit, or is too slow for a film
  int pixels = 0;          // that fire
  double first_us = 0;     // after the first step, of the first event
  double duration_us = 0;  // from the first to the last event of the first burst
  double delivered = 0;    // of the first burst
  double lost = 0;         // as the camera says, in the first burst
  double second_made = 0;  // by the pixels in a second burst that came while half of them waited
  double second_delivered = 0;
  double second_lost = 0;
};

Burst measure_burst(const EventCameraSpec& camera, std::uint64_t seed);

Check judge(const Burst& burst, const EventCameraSpec& expected);

}  // namespace dodgesim
