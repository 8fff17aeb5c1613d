// The force that keeps the vehicle out of an obstacle's way: Falanga et al. 2020, equations (26) to
// (33), and the decisions that the paper leaves open.
#pragma once

#include <Eigen/Dense>
#include <string>

#include "dodge/detect/ellipsoid.h"
#include "dodge/types.h"

namespace dodge {

struct RepulsiveConfig {
  std::string field = "falanga";
  double k_r0 = 4.0;
  double eta_0_m = 3.0;
  double gamma = 1.5;
  double lambda_decay_1ps = 10.0;
  double k_tau = 0.001;
  double quadrotor_radius_m = 0.15;
  bool scale_by_speed = true;
  std::string direction = "cross";
  bool upward = true;
  double head_on_sine = 0.05;
  double steep_deg = 45.0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("field", field, {"falanga", "khosla"},
      "Magnitude of the repulsive force: (28), or that of the classic field (27). As a whole the "
      "classic field has direction gradient, too, and neither scale_by_speed nor upward.");
    v("k_r0", k_r0, 0.0, 1000.0,
      "Repulsive constant at a detection (33). With |v| of (32) the force is in units of (m/s) per "
      "(m/s). Not given by the paper; first value from the authors' group's open code.");
    v("eta_0_m", eta_0_m, 0.01, 100.0,
      "Distance at which the field ends (28). Not given by the paper; same source as k_r0.");
    v("gamma", gamma, 0.1, 20.0,
      "Shape of the field. Positive: only then does (28) rise much faster than (27), as the paper "
      "says. At least 1 for khosla.");
    v("lambda_decay_1ps", lambda_decay_1ps, 0.01, 1000.0,
      "Decay of the repulsive constant since the last detection (33). Same source as k_r0.");
    v("k_tau", k_tau, 1e-12, 1000.0,
      "An obstacle is removed when its repulsive constant (33) has decayed below this, also with "
      "escape.law closest_approach.");
    v("quadrotor_radius_m", quadrotor_radius_m, 0.0, 10.0,
      "Taken off the distance between the vehicle's centre and the obstacle's surface.");
    v("scale_by_speed", scale_by_speed, "Whether the force grows with the obstacle's speed (32).");
    v("direction", direction, {"cross", "away", "gradient"},
      "Escape direction: the cross product (29); away from the obstacle's line of flight, in the "
      "plane of approach; or the gradient of the distance to the obstacle, as (27) has it.");
    v("upward", upward,
      "Whether the z component of each obstacle's force is replaced by its absolute value, as the "
      "paper does because a quadrotor accelerates upward best.");
    v("head_on_sine", head_on_sine, 0.0, 1.0,
      "Below this sine of the angle between distance gradient and velocity (29) is undefined in "
      "practice, and the escape is upward. An estimated velocity's direction is no better than 3 "
      "degrees.");
    v("steep_deg", steep_deg, 0.0, 90.0,
      "A head-on obstacle that climbs or falls more steeply than this is escaped from sideways, "
      "because upward would be along its path: to the left, or to the right if the left would go "
      "down.");
  }
};

// How long an obstacle is remembered after its last detection: until k_r (33) has decayed to k_tau.
double decay_lifetime_s(const RepulsiveConfig& config);

// What the field must know of the vehicle.
struct VehicleMotion {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  // [m/s]
  Eigen::Vector3d heading_W =
      Eigen::Vector3d::UnitX();  // unit, horizontal: B's x axis without tilt
};

class RepulsiveField {
 public:
  explicit RepulsiveField(const RepulsiveConfig& config);

  // Repulsive constant (33), so long after the last detection.
  double k_r(double since_detection_s) const;

  // |F| without |v|, (28) or (27), for a distance eta between the vehicle's hull and the obstacle:
  // in (m/s) per (m/s), or in m/s where the force does not scale with speed. eta < 0 (touching)
  // counts as 0.
  double magnitude(double eta_m, double k_r) const;

  // Unit escape direction for the gradient of the distance (unit, away from the obstacle) and the
  // obstacle's velocity [m/s]. Cross: (29), (30), orthogonal to the heading and made a unit vector
  // again, so that (28) alone sets the magnitude: as printed, an obstacle that crosses from the
  // side would hardly push. Where (29) or (30) vanish (head-on), the escape is upward, or sideways
  // if the obstacle flies steeply: to the left, or to the right if the left would go down. All of
  // these are orthogonal to the heading; the part along the obstacle's velocity is removed before
  // the one along the heading, so that a little of it may come back. Away: the same with the
  // gradient's part across the velocity in place of (29). Gradient: the gradient.
  Eigen::Vector3d direction(const Eigen::Vector3d& grad_eta_W, const Eigen::Vector3d& v_W,
                            const Eigen::Vector3d& heading_W) const;

  // The force (32) in W, a velocity for (39) [m/s]. Zero for an obstacle without motion when the
  // force scales with speed. v_obstacle_W in m/s.
  Eigen::Vector3d force(const VehicleMotion& vehicle, const Ellipsoid& obstacle,
                        const Eigen::Vector3d& v_obstacle_W, double since_detection_s) const;

 private:
  Eigen::Vector3d head_on_escape(const Eigen::Vector3d& along,
                                 const Eigen::Vector3d& heading_W) const;

  RepulsiveConfig config_;
  bool khosla_, cross_, gradient_;
  double steep_sine_;
};

}  // namespace dodge
