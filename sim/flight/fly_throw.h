// A throw of a campaign, with all the pilots that fly it.
#pragma once

#include "sim/config/scenario.h"
#include "sim/flight/flight_observer.h"
#include "sim/outcome/result.h"

namespace dodgesim {

// Throw `index` of a campaign with all its pilots: the scenario's own, `none` (would it have hit?)
// and, when the scenario asks for it, `oracle`. A simulation that fails, even before the throw, and
// a throw that is impossible are recorded with their reason as an error of the pilot that flew. A
// pure function of its arguments, up to wall-clock times. The observer, if any, watches the
// scenario's own pilot. Throws MemoryError, IoError, and ScenarioError where nothing can be drawn.
ThrowResult fly_throw(const Scenario& campaign, int index, FlightObserver* observer = nullptr);

}  // namespace dodgesim
