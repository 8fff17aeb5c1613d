// Results of throws that nobody flew, for the tests of what is done with results.
#pragma once

#include <string>

#include "sim/outcome/result.h"

namespace dodgesim {

inline FlightResult flown(bool hit, bool crashed = false) {
  FlightResult flight;
  flight.status = "ok";
  flight.hit = hit;
  flight.crashed = crashed;
  flight.clearance_m = hit ? 0.0 : 0.25;
  flight.closest_us = 1500250;
  if (hit) flight.hit_us = 1500000;
  return flight;
}

inline FlightResult failed(const std::string& reason) {
  FlightResult flight;
  flight.status = "error";
  flight.error = reason;
  return flight;
}

inline ThrowResult ball(int index, double size_m, double distance_m, double speed_mps) {
  ThrowResult result;
  result.index = index;
  result.object = "ball";
  result.size_m = size_m;
  result.distance_m = distance_m;
  result.speed_mps = speed_mps;
  return result;
}

}  // namespace dodgesim
