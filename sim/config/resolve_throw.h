// From a scenario's distributions to the numbers of one throw.
#pragma once

#include "sim/config/scenario.h"
#include "sim/world/throw.h"

namespace dodgesim {

// Throw number `index` (from 0) of the scenario, a pure function of (throw, seed, index). Every key
// draws from a stream of its own, so that changing one key leaves the draws of the others alone.
// Requires scenario.toss.
Throw resolve_throw(const Scenario& scenario, int index);

}  // namespace dodgesim
