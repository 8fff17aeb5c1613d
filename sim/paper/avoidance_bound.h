// The bound of "How Fast is Too Fast? The Role of Perception Latency in High-Speed Sense and Avoid"
// (Falanga, Kim, Scaramuzza, RA-L 2019).
#pragma once

#include <functional>

#include "sim/config/scenario.h"

namespace dodgesim {

// An object comes straight at a vehicle at rest. It is first seen at the distance s, the vehicle
// learns of it the latency tau later, and then needs t_a to get out of its way. In time is
//   tau <= s / v - t_a.
struct AvoidanceBound {
  double range_m = 0;                                // s
  std::function<double(double speed_mps)> escape_s;  // t_a; s / v - t_a falls with the speed

  double greatest_latency_s(double speed_mps) const {
    return range_m / speed_mps - escape_s(speed_mps);
  }
  double least_range_m(double speed_mps, double latency_s) const {
    return speed_mps * (latency_s + escape_s(speed_mps));
  }
  // To within 1 mm/s and what t_a is known to, at most 100 m/s.
  double greatest_speed_mps(double latency_s) const;
};

// t_a of a point that accelerates at once and evenly: sqrt(2 r / u).
double point_avoidance_s(double distance_m, double acceleration_mps2);

// Bounds for the scenario's vehicle, at rest, and a ball of 20 cm (the mean of 10, 20 and 30) that
// comes level and ahead at its centre.
// A point: to the side, with all the vehicle's thrust but what keeps its height, at once.
AvoidanceBound point_bound(const Scenario& scenario, double range_m);
// Its rotors, by the manoeuvres of agility.h. s is the distance from the first camera, and
// the ball arrives when it touches the hull. t_a is known to a millisecond.
AvoidanceBound rotors_bound(const Scenario& scenario, double range_m);

// From light to the rotors' command, without what the pilot takes: the pixel's latency, the rest of
// the packet, transport, the time until the next cycle begins (these three in the mean), the link
// and the flight controller.
double latency_without_pilot_s(const Scenario& scenario);

}  // namespace dodgesim
