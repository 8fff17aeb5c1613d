// Where to go, given the obstacles and the goal: the sum of the potential fields as a velocity, or
// an escape by predicted closest approach in place of the repulsive field.
#pragma once

#include <span>
#include <vector>

#include "dodge/avoid/attractive_field.h"
#include "dodge/avoid/escape.h"
#include "dodge/avoid/repulsive_field.h"
#include "dodge/avoid/velocity_command.h"
#include "dodge/detect/tracker.h"
#include "dodge/types.h"

namespace dodge {

class Avoider {
 public:
  Avoider(const RepulsiveConfig& repulsive, const AttractiveConfig& attractive,
          const VelocityLimitConfig& limit, const EscapeConfig& escape);

  // The velocity command at `now_us`. Vehicle and obstacles are moved on from the instants of their
  // states to `now_us`, at constant velocity or, obstacles with an escape's law, in free fall.
  // Obstacles that are not confirmed, or not finite, do not act. Call once a cycle.
  VelocityCommand command(TimeUs now_us, const StateEstimate& state, const Goal& goal,
                          std::span<const TrackedObstacle> obstacles);

 private:
  // By the field, or by the escape's law.
  VelocityCommand decide(TimeUs now_us, const VehicleMotion& vehicle, const Goal& goal);
  Eigen::Vector3d repulsion(TimeUs now_us, const VehicleMotion& vehicle) const;

  RepulsiveField repulsive_;
  AttractiveConfig attractive_;
  VelocityLimitConfig limit_;
  CommandRamp ramp_;
  EscapePlanner escape_;
  bool predicts_;
  std::vector<TrackedObstacle> acting_;  // those of the last command that act
};

}  // namespace dodge
