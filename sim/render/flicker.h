// The flicker of lamps on the mains: their power, and so the light of the room, swings at twice the
// mains' frequency.
#pragma once

#include <cstdint>

#include "sim/base/time.h"
#include "sim/render/spec.h"

namespace dodgesim {

// Of the lamps in a throw.
double flicker_phase_rad(std::uint64_t seed, std::uint64_t throw_index);

// By what the mean luminance is multiplied at t_us: 1 + depth sin(2 pi f t + phase), at least 0.
double flicker_factor(const FlickerSpec& spec, double phase_rad, TimeUs t_us);

// The rate at which an image must be sampled so that straight lines follow the swing; 0 for none.
double flicker_sampling_hz(const FlickerSpec& spec);

}  // namespace dodgesim
