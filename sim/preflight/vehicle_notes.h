// What flies, but not as its pilot takes it to.
#pragma once

#include <string>
#include <vector>

#include "sim/config/scenario.h"

namespace dodgesim {

// A sentence on each
// - vehicle whose hull does not reach as far, to a fifth, as a pilot that escapes by the closest
//   approach believes (dodger.escape.hull_radius_m);
// - cruise speed from which the nominal vehicle cannot brake within dodger.attractive.e_0_m, so
//   that it swings through its goal forever.
// After try_models() (try_models.h).
std::vector<std::string> vehicle_notes(const Scenario& campaign);

}  // namespace dodgesim
