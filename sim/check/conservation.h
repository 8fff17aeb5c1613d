// No pixel loses what it has seen: after any film, the signal of each is within its thresholds of
// its reference, and each still answers to light.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/check/check.h"
#include "sim/events/event_camera.h"

namespace dodgesim {

struct PixelsAfterFilm {
  std::vector<PixelState> pixels;  // after a film of a drifting texture
  std::vector<bool> answered;      // to large steps that came after it
  double step = 0;                 // of the response
};

PixelsAfterFilm measure_conservation(const EventCameraSpec& camera, std::uint64_t seed);

Check judge(const PixelsAfterFilm& after, const EventCameraSpec& expected);

}  // namespace dodgesim
