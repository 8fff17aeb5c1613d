// All parameters of the paper's pilot, composed from the parameters of its stages.
#pragma once

#include <vector>

#include "dodge/avoid/attractive_field.h"
#include "dodge/avoid/escape.h"
#include "dodge/avoid/repulsive_field.h"
#include "dodge/avoid/velocity_command.h"
#include "dodge/camera_model.h"
#include "dodge/detect/association.h"
#include "dodge/detect/cluster.h"
#include "dodge/detect/depth.h"
#include "dodge/detect/ego_motion.h"
#include "dodge/detect/event_window.h"
#include "dodge/detect/kalman.h"
#include "dodge/detect/optical_flow.h"
#include "dodge/detect/time_image.h"
#include "dodge/monitor/height_monitor.h"
#include "dodge/monitor/landing.h"
#include "dodge/monitor/range_height.h"

namespace dodge {

// The defaults are the pilot of Falanga et al. 2020, with what its paper does not say filled in:
// events warped to the window's end (EgoMotionConfig), rho averaged before the cut
// (TimeImageConfig), clusters of few pixels or events or of a long shape left out (ClusterConfig),
// the disparity by correlation, joined rectangles, and what correlates too little or is of no
// credible size left out (DepthConfig), detections that confirm an obstacle (AssociationConfig),
// (30) made a unit vector and an escape where (29) and (30) vanish (RepulsiveConfig), a limit of
// the speed (VelocityLimitConfig).
struct Config {
  // Set by whatever carries the core; not parameters of the pilot. Stereo needs two cameras, the
  // upper one first; mono uses the first. The range sensor at p_BR [m] looks along -z of B.
  std::vector<CameraModel> cameras;
  Eigen::Vector3d p_BR = Eigen::Vector3d::Zero();

  WindowConfig window;
  EgoMotionConfig ego_motion;
  TimeImageConfig time_image;
  FlowConfig flow;
  ClusterConfig cluster;
  DepthConfig position;
  AssociationConfig association;
  KalmanConfig kalman;
  RepulsiveConfig repulsive;
  AttractiveConfig attractive;
  EscapeConfig escape;
  VelocityLimitConfig velocity_limit;
  RangeSensorConfig range_sensor;
  HeightMonitorConfig height_monitor;
  LandingConfig landing;

  template <class Visitor>
  void visit(Visitor& v) {
    v("window", window, "The sliding window of events.");
    v("ego_motion", ego_motion, "Compensation of the camera's rotation, eq. (1).");
    v("time_image", time_image, "Time image, threshold and morphology, eqs. (2) to (4).");
    v("flow", flow, "Optical flow of the time image.");
    v("cluster", cluster, "Grouping of pixels into obstacles, eq. (6).");
    v("position", position, "Depth, size and position of obstacles, eqs. (7) to (12).");
    v("association", association, "Which detection belongs to which obstacle.");
    v("kalman", kalman, "Filter of an obstacle's position and velocity, eqs. (13) to (25).");
    v("repulsive", repulsive,
      "Force away from obstacles, eqs. (26) to (33). With escape.law closest_approach, as of the "
      "pilot dodgesim, it only says how long an obstacle is remembered.");
    v("attractive", attractive, "Force towards the goal, eqs. (35), (36).");
    v("escape", escape, "Escape by predicted closest approach, in place of the repulsive force.");
    v("velocity_limit", velocity_limit, "Limits of the commanded velocity, eq. (39).");
    v("range_sensor", range_sensor, "Which readings of the range sensor that looks down are used.");
    v("height_monitor", height_monitor,
      "Lands the vehicle when the estimated height has drifted away from the measured one.");
    v("landing", landing, "The emergency landing; on its way down the vehicle dodges nobody.");
  }
};

// Throws std::invalid_argument, with a sentence that names the parameter or camera, if a value is
// out of its range, parameters contradict each other, a calibration is not finite or its pose no
// rigid motion, or the cameras do not fit the way depth is measured.
//
// This is the one place that checks: Dodger's constructor calls it, as the simulator does before it
// flies any pilot. The single stages take their parameters as they are. Who uses one by itself
// calls this first, or check_ranges() for its parameters alone.
void validate(const Config& config);

}  // namespace dodge
