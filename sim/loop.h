// One throw.
#pragma once

#include "sim/flight/flight.h"

namespace dodgesim {

// Flies the plan, tick by tick.
FlightRecord fly(const Scenario& scenario, const FlightPlan& plan,
                 FlightObserver* observer = nullptr, FlightTiming* timing = nullptr);

// The plan of a throw of a scenario without grid and sweep: draws its numbers, finds out where the
// vehicle will be when the object arrives if nobody dodges, and solves the throw for that place.
FlightPlan plan_throw(const Scenario& scenario, int throw_index);

// Throw `index` of a campaign with all its pilots: the scenario's own, `none` (would it have hit?)
// and, when the scenario asks for it, `oracle`. A simulation that fails, even before the throw, and
// a throw that is impossible are recorded with their reason as an error of the pilot that flew. A
// pure function of its arguments, up to wall-clock times. The observer, if any, watches the
// scenario's own pilot.
ThrowResult fly_throw(const Scenario& campaign, int index, FlightObserver* observer = nullptr);

}  // namespace dodgesim
