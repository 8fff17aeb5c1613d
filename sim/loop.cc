#include "sim/loop.h"

namespace dodgesim {

FlightRecord fly(const Scenario& scenario, const FlightPlan& plan, FlightObserver* observer) {
  Flight flight(scenario, plan, observer);
  while (!flight.over()) {
    flight.move();
    flight.sense();
    flight.see();
    flight.decide();
    flight.control();
    flight.judge();
  }
  return flight.record();
}

}  // namespace dodgesim
