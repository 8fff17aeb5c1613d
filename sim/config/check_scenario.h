// What a single range for each key cannot say.
#pragma once

#include "sim/config/reader.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// Adds to the problems of `context`, in which the scenario was read, what is wrong with keys that
// need each other, with the values of grid and sweep, and with any combination of these.
void check_scenario(const Scenario& scenario, ReadContext& context);

}  // namespace dodgesim
