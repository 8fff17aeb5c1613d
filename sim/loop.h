// One flight, tick by tick.
#pragma once

#include "sim/flight/flight.h"

namespace dodgesim {

// Throws ScenarioError (models) and SimulationError.
FlightRecord fly(const Scenario& scenario, const FlightPlan& plan,
                 FlightObserver* observer = nullptr);

}  // namespace dodgesim
