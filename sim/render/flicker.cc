#include "sim/render/flicker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dodgesim {

namespace {

// Straight lines between so many samples of a period stay within 1.3 % of the swing.
constexpr double kSamplesPerPeriod = 20;

}  // namespace

double flicker_factor(const FlickerSpec& spec, double phase_rad, TimeUs t_us) {
  if (spec.flicker_hz <= 0) return 1;
  // Whole periods are taken off first: the sine's argument stays small and exact.
  const double periods = spec.flicker_hz * seconds(t_us);
  const double angle_rad = 2 * std::numbers::pi * (periods - std::floor(periods)) + phase_rad;
  return std::max(0.0, 1 + spec.flicker_depth * std::sin(angle_rad));
}

double flicker_sampling_hz(const FlickerSpec& spec) {
  return spec.flicker_depth > 0 ? kSamplesPerPeriod * spec.flicker_hz : 0;
}

}  // namespace dodgesim
