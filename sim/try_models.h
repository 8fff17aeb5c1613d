// Are the models of a campaign any good?
#pragma once

#include "sim/config/scenario.h"

namespace dodgesim {

// Tries every room with every vehicle and all objects that the campaign names, in child processes.
// Throws ScenarioError as try_world() does.
void try_models(const Scenario& campaign);

}  // namespace dodgesim
