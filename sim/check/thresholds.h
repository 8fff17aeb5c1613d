// The contrast thresholds, as a slow ramp of log luminance shows them.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/check/check.h"
#include "sim/events/spec.h"

namespace dodgesim {

struct MeasuredThresholds {
  std::vector<double> on, off;  // of the pixels that fired often enough, in log luminance
  int pixels = 0;               // of the camera
};

MeasuredThresholds measure_thresholds(const EventCameraSpec& camera, std::uint64_t seed);

Check judge(const MeasuredThresholds& measured, const EventCameraSpec& expected);

// Mean and standard deviation of max(lowest, X) for a normal X.
struct Moments {
  double mean, sd;
};
Moments clipped_normal(double mean, double sd, double lowest);

}  // namespace dodgesim
