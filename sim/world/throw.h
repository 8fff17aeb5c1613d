// A throw: where and when an object leaves the hand, and the velocity that takes it to the aim
// point.
#pragma once

#include <Eigen/Dense>

#include "sim/base/time.h"
#include "sim/world/compose.h"
#include "sim/world/snapshot.h"
#include "sim/world/world.h"

namespace dodgesim {

// One throw with every number drawn. Object i of the world flies throw i.
//
// The aim point is where the vehicle's centre will be on arrival if it goes on as planned, moved by
// the aim offset across the horizontal line of flight. The object leaves the hand at the launch
// height, distance_m from the aim point over the ground, in the direction of the bearing, and
// reaches the aim point after exactly distance_m / speed_mps: there is one such flight, no choice
// between a low and a high arc, and slow throws are lobs.
struct Throw {
  ObjectSpec object;
  double speed_mps = 6;    // the object's own mean speed over the ground
  double distance_m = 3;   // over the ground, from the launch to the aim point
  double bearing_deg = 0;  // where it comes from, against the vehicle's heading, positive left
  Eigen::Vector2d aim_offset_m = Eigen::Vector2d::Zero();  // left, up, for a viewer at the vehicle
                                                           // who looks at the launch point
  double launch_height_m = 1.5;                            // z of W
  Eigen::Vector3d spin_radps = Eigen::Vector3d::Zero();    // angular velocity in W at launch
  TimeUs launch_us = 0;

  double flight_s() const { return distance_m / speed_mps; }
  TimeUs arrival_us() const;  // rounded to the microsecond
};

// State of the object at launch. aim_p_W: where the vehicle's centre will be at arrival_us();
// heading_rad: the vehicle's yaw. The flight passes the aim point to 0.1 mm (where the
// vehicle's place is known by the tick only, as in plan.cc, to a tick of its way).
// Throws ScenarioError for numbers that are no throw (not finite, not positive) and for one that
// the drag makes impossible.
BodyState solve_throw(const Throw& toss, const ObjectPhysics& object,
                      const Eigen::Vector3d& aim_p_W, double heading_rad);

// The aim point itself: aim_p_W moved by the offset.
Eigen::Vector3d aim_point(const Throw& toss, const Eigen::Vector3d& aim_p_W, double heading_rad);

// Where a free flight with gravity and drag is after `time_s`. p_W and v_W are updated.
void fly(const ObjectPhysics& object, double time_s, Eigen::Vector3d& p_W, Eigen::Vector3d& v_W);

}  // namespace dodgesim
