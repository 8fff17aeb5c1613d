// Escape by predicted closest approach, an extension of the paper that takes the place of its
// potential field: the vehicle evades what will probably hit it if it flies on, as soon as that is
// known well enough, in the direction in which it gets out of the way best, and keeps to it.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dodge/avoid/repulsive_field.h"
#include "dodge/detect/tracker.h"

namespace dodge {

struct EscapeConfig {
  std::string law = "potential_field";
  double hull_radius_m = 0.25;
  double control_sigma_m = 0.05;
  double min_probability = 0.3;
  double keep_probability = 0.02;
  double min_speed_mps = 1.5;
  double horizon_s = 1.0;
  double acceleration_mps2 = 20;
  double dead_time_s = 0.04;
  double tilt_time_s = 0.05;
  double turn_sigmas = 1;
  double steepest_descent_deg = 15;

  template <class Visitor>
  void visit(Visitor& v) {
    v("law", law, {"potential_field", "closest_approach"},
      "What decides on an escape: the paper's field (repulsive), or whether an obstacle will "
      "probably hit (the other keys here).");
    v("hull_radius_m", hull_radius_m, 0.0, 10.0,
      "Radius of a ball around the vehicle: half the diagonal of its hull of 0.34 x 0.34 x 0.10 "
      "m.");
    v("control_sigma_m", control_sigma_m, 1e-3, 10.0,
      "Standard deviation, per axis, of where the vehicle will be from where it is predicted. With "
      "the obstacle's it counts as no less than a tenth of both radii together.");
    v("min_probability", min_probability, 0.0, 0.99,
      "Least probability of a hit that starts an escape. The estimate of a far obstacle is so "
      "vague that no hit is probable; it earns its range as its covariance shrinks.");
    v("keep_probability", keep_probability, 0.0, 1.0,
      "An escape goes on while a hit is at least as probable: what is out of sight is predicted, "
      "and ever more vaguely.");
    v("min_speed_mps", min_speed_mps, 0.0, 100.0,
      "Obstacles slower than this in the world are not thrown: background that moves with the "
      "vehicle's estimate. What once set off an escape may be slower, as a ball is where it "
      "turns.");
    v("horizon_s", horizon_s, 0.1, 10.0, "How far ahead courses are predicted.");
    v("acceleration_mps2", acceleration_mps2, 0.1, 1000.0,
      "Acceleration of an escape, measured with the nominal vehicle and controller.");
    v("dead_time_s", dead_time_s, 0.0, 1.0,
      "From a command to its thrust, without the time to tilt: delays and motors.");
    v("tilt_time_s", tilt_time_s, 0.0, 1.0,
      "Time to tilt for an escape to the side; an escape upward needs none.");
    v("turn_sigmas", turn_sigmas, 0.0, 1000.0,
      "An escape keeps its direction until another clears the obstacles by so many standard "
      "deviations more: who plans anew in each cycle tilts to and fro, and moves nowhere.");
    v("steepest_descent_deg", steepest_descent_deg, 0.0, 90.0,
      "No escape goes down more steeply: thrust cannot push down, and there is the ground.");
  }
};

// What the vehicle will be commanded.
struct Intent {
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  // velocity [m/s]
  std::optional<Eigen::Vector3d> p_WG;            // where it stops, if it does
  double acceleration_mps2 = 0;                   // towards v_W; 0: EscapeConfig::acceleration_mps2
};

// The closest approach of an obstacle to the vehicle.
struct Meeting {
  double time_s = 0;                                     // from now
  Eigen::Vector3d miss_W = Eigen::Vector3d::Zero();      // obstacle's centre from the vehicle's [m]
  Eigen::Vector3d along_W = Eigen::Vector3d::UnitX();    // unit, their relative velocity
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of miss_W [m^2]
  double radius_m = 0;  // they touch when the length of miss_W is less
};

// Probability that the vehicle is hit: the integral of the normal distribution of the miss, across
// the relative velocity, over the disc of that radius. To 1e-3 where no standard deviation is less
// than a tenth of the radius.
double hit_probability(const Meeting& meeting);

class EscapePlanner {
 public:
  // speed_mps: of an escape.
  EscapePlanner(const EscapeConfig& config, double speed_mps);

  // The velocity of an escape [m/s], or nothing while no confirmed obstacle will, within the
  // horizon, probably hit a vehicle that follows `intent`. `vehicle` is the state at `now_us`. Call
  // once a cycle: what has been answered decides which probability counts.
  std::optional<Eigen::Vector3d> escape(TimeUs now_us, const VehicleMotion& vehicle,
                                        const Intent& intent,
                                        std::span<const TrackedObstacle> obstacles);

  // How an obstacle, in free fall, meets a vehicle that follows `intent` from `now_us` on; nothing
  // if they do not come nearer. Beyond the horizon both fly on straight.
  std::optional<Meeting> meeting(TimeUs now_us, const VehicleMotion& vehicle, const Intent& intent,
                                 const TrackedObstacle& obstacle) const;

 private:
  struct Danger {
    int id;              // of the obstacle
    double probability;  // of a hit
    Eigen::Vector3d along_W;
  };

  bool has_evaded(int id) const;
  bool is_thrown(const TrackedObstacle& tracked) const;
  std::optional<Danger> greatest_danger(TimeUs now_us, const VehicleMotion& vehicle,
                                        const Intent& intent,
                                        std::span<const TrackedObstacle> obstacles) const;
  double clearance_in_sigmas(TimeUs now_us, const VehicleMotion& vehicle, const Intent& intent,
                             std::span<const TrackedObstacle> obstacles) const;
  Eigen::Vector3d best_direction(TimeUs now_us, const VehicleMotion& vehicle,
                                 const Eigen::Vector3d& along_W,
                                 std::span<const TrackedObstacle> obstacles) const;

  EscapeConfig config_;
  double speed_mps_;
  double lowest_z_;                             // of an escape's unit direction
  std::vector<int> evaded_ids_;                 // of tracked obstacles that have set off an escape
  std::optional<Eigen::Vector3d> direction_W_;  // of the escape under way
};

}  // namespace dodge
