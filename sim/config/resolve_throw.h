// From a scenario's distributions to the numbers of one throw.
#pragma once

#include <vector>

#include "sim/config/scenario.h"
#include "sim/world/throw.h"

namespace dodgesim {

// The objects of throw number `index` (from 0), in the order of the scenario: a pure function of
// (throw or throws, seed, index). Every key of every object draws from a stream of its own, so that
// changing one leaves the draws of the others alone. Empty when nobody throws.
std::vector<Throw> resolve_throws(const Scenario& scenario, int index);

}  // namespace dodgesim
