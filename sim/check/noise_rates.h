// Rates of the noise, each kind by itself with the others switched off: a noise event resets its
// pixel, so together they hinder each other.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/check/check.h"
#include "sim/events/spec.h"
#include "sim/events/thresholds.h"

namespace dodgesim {

// Events of one kind of noise on a constant scene.
struct NoiseCount {
  bool filmed = false;  // false: that kind is switched off
  double duration_s = 0;
  double on = 0, off = 0;  // events
  double other = 0;        // events that are said to have another cause
  // Of each pixel of the camera.
  std::vector<Thresholds> thresholds;
  std::vector<double> per_pixel, per_pixel_on;  // events
};

struct NoiseCounts {
  NoiseCount leak, shot_dark, shot_bright, hot;
  NoiseCount all_hot;  // of a camera all of whose pixels are hot
};

NoiseCounts measure_noise(const EventCameraSpec& camera, std::uint64_t seed);

// Mean number of events of a pixel whose noise comes at random, at rate_hz while it is not held
// [hold_s] after an event; it is not held at first.
double events_expected(double rate_hz, double hold_s, double duration_s);

Check judge(const NoiseCounts& counts, const EventCameraSpec& expected);

}  // namespace dodgesim
