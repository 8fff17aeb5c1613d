// How much the events depend on how often the light is sampled.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/check/check.h"
#include "sim/check/compare_events.h"
#include "sim/events/spec.h"

namespace dodgesim {

struct Sampled {
  double displacement_px = 0;  // of the texture from sample to sample
  EventDifference difference;  // from the reference
};

// From the finest to the coarsest. The reference is sampled eight times finer than
// SamplingSpec::max_displacement_px asks for.
std::vector<Sampled> measure_convergence(const EventCameraSpec& camera, std::uint64_t seed);

// The limits hold at SamplingSpec::max_displacement_px; the other rates are for the plots.
Check judge(const std::vector<Sampled>& rates);

}  // namespace dodgesim
