// The state estimate of a visual-inertial odometry fused with the IMU by an extended Kalman filter,
// as truth plus a model of its error.
#pragma once

#include "sim/sensors/gauss_markov.h"
#include "sim/sensors/readings.h"
#include "sim/sensors/sample_clock.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

// No error budget of the flown estimator was published. The defaults are assumptions: the size that
// visual-inertial odometry reaches indoors at hover, small against the 5 cm within which the
// vehicle must hold its place.
struct StateEstimateSpec {
  int rate_hz = 250;
  double position_walk_m_sqrts = 0.001;
  double position_white_m = 0.002;
  double velocity_bias_mps = 0.02;
  double velocity_bias_correlation_s = 1.0;
  double velocity_white_mps = 0.01;
  double yaw_walk_rad_sqrts = 0.001;
  double tilt_error_rad = 0.005;
  double tilt_error_correlation_s = 5;
  double attitude_white_rad = 0.001;
  double rate_white_radps = 0.02;
  double height_drift_mps = 0;
  double height_drift_start_s = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("rate_hz", rate_hz, 1, 4000,
      "Estimates per second (paper: 250); it must divide 4000. At each the velocity controller "
      "acts, and at once on a command to evade: other commands wait for up to a period.");
    v("position_walk_m_sqrts", position_walk_m_sqrts, 0, 10,
      "Random walk of the position's error, unbounded as odometry is: 0.8 cm after a minute of "
      "hover (assumed).");
    v("position_white_m", position_white_m, 0, 1,
      "White noise of the position, per axis and estimate (assumed).");
    v("velocity_bias_mps", velocity_bias_mps, 0, 10,
      "Standard deviation of the slowly varying velocity error, per axis (assumed).");
    v("velocity_bias_correlation_s", velocity_bias_correlation_s, 0.001, 10000,
      "Time over which that error forgets itself: some thirty of the camera-driven updates "
      "(assumed).");
    v("velocity_white_mps", velocity_white_mps, 0, 10,
      "White noise of the velocity, per axis and estimate (assumed).");
    v("yaw_walk_rad_sqrts", yaw_walk_rad_sqrts, 0, 1,
      "Random walk of the heading's error: 0.4 deg after a minute (assumed). It turns attitude and "
      "velocity, but not the position, so that an error of a radian makes the vehicle spiral.");
    v("tilt_error_rad", tilt_error_rad, 0, 1,
      "Standard deviation of the roll and pitch error, which gravity bounds (assumed).");
    v("tilt_error_correlation_s", tilt_error_correlation_s, 0.001, 10000,
      "Time over which the roll and pitch error forgets itself (assumed).");
    v("attitude_white_rad", attitude_white_rad, 0, 1,
      "White noise of the attitude, per axis and estimate (assumed).");
    v("rate_white_radps", rate_white_radps, 0, 10,
      "White noise of the angular velocity after the filter's smoothing, per axis (assumed).");
    v("height_drift_mps", height_drift_mps, -10, 10,
      "Rate at which the estimated height rises above the true one, as odometry that has lost its "
      "features does; the estimated vertical velocity is wrong by as much. A vehicle that holds "
      "its estimated height sinks at this rate.");
    v("height_drift_start_s", height_drift_start_s, 0, 3600,
      "When that drift begins, after the start of the flight.");
  }
};

// The heading error turns attitude and velocity, not the position, which has a walk of its own.
// Errors of tilt are about the world's horizontal axes. All processes are discretised exactly.
class StateEstimator {
 public:
  // Throws ScenarioError if the rate does not fit the ticks.
  StateEstimator(const StateEstimateSpec& spec, std::uint64_t seed, std::uint64_t throw_index);

  bool due(TimeUs t_us) const { return clock_.due(t_us); }

  // Call at increasing instants.
  StateReading sample(const Snapshot& truth);

  // At the last sample.
  const FrameDrift& drift() const { return drift_; }

 private:
  void step_drift(TimeUs t_us, double dt_s);

  StateEstimateSpec spec_;
  SampleClock clock_;
  GaussMarkov<3> position_walk_;
  GaussMarkov<3> velocity_bias_;
  GaussMarkov<1> yaw_walk_;
  GaussMarkov<2> tilt_error_;
  RandomStream position_white_;
  RandomStream velocity_white_;
  RandomStream attitude_white_;
  RandomStream rate_white_;
  FrameDrift drift_;
};

}  // namespace dodgesim
