// Time stamps do not clump at the instants at which the light is sampled.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/check/check.h"
#include "sim/events/spec.h"

namespace dodgesim {

struct StampPhases {
  // When an event's light changed: 0 at a sample, 1 at the next.
  std::vector<double> phases;
};

StampPhases measure_stamps(const EventCameraSpec& camera, std::uint64_t seed);

Check judge(const StampPhases& measured);

}  // namespace dodgesim
