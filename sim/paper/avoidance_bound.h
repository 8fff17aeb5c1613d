// The bound of "How Fast is Too Fast? The Role of Perception Latency in High-Speed Sense and Avoid"
// (Falanga, Kim, Scaramuzza, RA-L 2019).
#pragma once

#include "sim/config/scenario.h"

namespace dodgesim {

// An object comes straight at a vehicle at rest. It is first seen at the distance s, the vehicle
// learns of it the latency tau later, and then needs t_a to get out of its way. In time is
//   tau <= s / v - t_a.
struct AvoidanceBound {
  double range_m = 0;      // s
  double avoidance_s = 0;  // t_a

  double greatest_latency_s(double speed_mps) const { return range_m / speed_mps - avoidance_s; }
  double greatest_speed_mps(double latency_s) const { return range_m / (latency_s + avoidance_s); }
};

// Mean radius of balls of 10, 20 and 30 cm.
inline constexpr double kMeanBallRadiusM = 0.1;

// t_a of a point that accelerates at once and evenly: sqrt(2 r / u).
double point_avoidance_s(double distance_m, double acceleration_mps2);

// t_a of the scenario's vehicle, at rest, from a ball that comes level and ahead at its centre.
struct AvoidanceTimes {
  double point_s = 0;   // to the side, with all its thrust but what keeps its height, at once
  double rotors_s = 0;  // in the best direction, with the rotors' lag and the time to tilt
                        // (least_time_to_escape_s() of collision_cause.h)
};
AvoidanceTimes avoidance_times(const Scenario& scenario, double ball_radius_m);

// From light to the rotors' command, without what the pilot takes: the pixel's latency, transport,
// half a cycle until the next one begins, the link and the flight controller.
double latency_without_pilot_s(const Scenario& scenario);

}  // namespace dodgesim
