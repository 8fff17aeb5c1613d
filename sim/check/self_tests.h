// All self-tests of the event camera, for whoever runs them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/check/check.h"
#include "sim/events/spec.h"

namespace dodgesim {

// Each films the camera when it is called. Synthetic scenes only.
std::vector<std::function<Check()>> sensor_checks(const EventCameraSpec& camera,
                                                  std::uint64_t seed);

}  // namespace dodgesim
