#include "sim/render/flicker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/random.h"

namespace dodgesim {

namespace {

// Straight lines between so many samples of a period stay within 1.3 % of the swing.
constexpr double kFewestPerPeriod = 20;

// Where the light goes nearly out, its logarithm dips sharply. Straight lines between samples stay
// within this of it, while it has this share of its mean left.
constexpr double kLogError = 0.003;
constexpr double kLeastLight = 0.02;

}  // namespace

double flicker_phase_rad(std::uint64_t seed, std::uint64_t throw_index) {
  return 2 * std::numbers::pi * RandomStream(seed, throw_index, "flicker").uniform();
}

double flicker_factor(const FlickerSpec& spec, double phase_rad, TimeUs t_us) {
  if (spec.flicker_hz <= 0) return 1;
  // Whole periods are taken off first: the sine's argument stays small and exact.
  const double periods = spec.flicker_hz * seconds(t_us);
  const double angle_rad = 2 * std::numbers::pi * (periods - std::floor(periods)) + phase_rad;
  return std::max(0.0, 1 + spec.flicker_depth * std::sin(angle_rad));
}

double flicker_sampling_hz(const FlickerSpec& spec) {
  if (spec.flicker_depth <= 0) return 0;
  // At the minimum the logarithm's second derivative in the phase is d / (1 - d).
  const double bend = spec.flicker_depth / std::max(1 - spec.flicker_depth, kLeastLight);
  const double per_period = 2 * std::numbers::pi * std::sqrt(bend / (8 * kLogError));
  return std::max(kFewestPerPeriod, per_period) * spec.flicker_hz;
}

}  // namespace dodgesim
