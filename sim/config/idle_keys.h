// Keys of a scenario that change nothing.
#pragma once

#include <string>
#include <vector>

#include "sim/config/scenario.h"

namespace dodgesim {

// "file:line:column: oracle.range_cap_m has no effect: ...", for keys that the scenario gives
// although it flies nothing that they are about; only where that is certain. None for a resolved
// scenario, which gives all keys.
std::vector<std::string> idle_keys(const Scenario& scenario);

}  // namespace dodgesim
