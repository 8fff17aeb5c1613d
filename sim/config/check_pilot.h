// Settings with which a pilot could never see, evade or land.
#pragma once

#include "sim/config/reader.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// Adds to the problems of `context` what the flight core says of its parameters, and what of them
// does not go together with the sensors and the delays.
void check_pilot(const Scenario& scenario, ReadContext& context);

}  // namespace dodgesim
