// What happens in a flight, before anybody flies.
#pragma once

#include <string>
#include <vector>

#include "sim/base/time.h"
#include "sim/config/pilot.h"
#include "sim/config/scenario.h"
#include "sim/flight/flight_observer.h"
#include "sim/world/snapshot.h"
#include "sim/world/throw.h"

namespace dodgesim {

// Which throw is flown, how, and until when.
struct FlightPlan {
  int throw_index = 0;
  std::string pilot = kPaperPilot;  // of those in sim/config/pilot.h
  struct Launch {
    Throw drawn;
    BodyState state;  // at drawn.launch_us
  };
  std::vector<Launch> launches;  // object i of the world is launch i
  TimeUs end_us = 0;
};

// The plan of a throw of a scenario without grid and sweep: draws its numbers, finds out where the
// vehicle will be when the object arrives if nobody dodges, and solves the throw for that place.
// The observer sees the vehicle fly there. Throws ScenarioError and SimulationError.
FlightPlan plan_throw(const Scenario& scenario, int throw_index,
                      FlightObserver* observer = nullptr);

}  // namespace dodgesim
