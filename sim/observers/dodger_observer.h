// Looks into the paper's pilot: makes it keep its stages, and is shown it after each of its cycles.
// Of other pilots it sees nothing.
#pragma once

#include "dodge/dodger.h"
#include "sim/flight/flight_observer.h"

namespace dodgesim {

class DodgerObserver : public FlightObserver {
 public:
  void on_start(dodge::Pilot& pilot) final {
    if (auto* dodger = dynamic_cast<dodge::Dodger*>(&pilot)) dodger->set_capture(true);
  }
  void on_cycle(TimeUs now_us, const dodge::Pilot& pilot) final {
    const auto* dodger = dynamic_cast<const dodge::Dodger*>(&pilot);
    if (dodger != nullptr) on_dodger_cycle(now_us, *dodger);
  }
  virtual void on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) = 0;
};

}  // namespace dodgesim
