// The pilot plugin of a campaign.
#pragma once

#include "sim/config/scenario.h"

namespace dodgesim {

// Makes the pilot that the campaign's library flies, once from each configuration, in child
// processes, because it may crash. Throws ScenarioError with one sentence if it cannot be
// made, if the campaign flies the pilot plugin and has no library, or has one and does not.
// SimulationError if no process can be made. After try_models() (try_models.h).
void try_plugin(const Scenario& campaign);

}  // namespace dodgesim
