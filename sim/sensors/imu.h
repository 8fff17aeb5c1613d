// Gyroscope and accelerometer.
#pragma once

#include <string_view>

#include "sim/sensors/gauss_markov.h"
#include "sim/sensors/readings.h"
#include "sim/sensors/sample_clock.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

struct ImuSpec {
  int rate_hz = 1000;
  double gyro_density_radps_sqrthz = 1.75e-4;
  double gyro_walk_radps2_sqrthz = 1.9e-5;
  double gyro_initial_bias_radps = 1e-3;
  double gyro_vibration_radps = 0.03;
  double gyro_range_radps = 34.9;
  double accelerometer_density_mps2_sqrthz = 2e-3;
  double accelerometer_walk_mps3_sqrthz = 3e-3;
  double accelerometer_initial_bias_mps2 = 0.02;
  double accelerometer_vibration_mps2 = 0.5;
  double accelerometer_range_mps2 = 157;

  template <class Visitor>
  void visit(Visitor& v) {
    v("rate_hz", rate_hz, 1, 4000, "Samples per second; it must divide 4000.");
    v("gyro_density_radps_sqrthz", gyro_density_radps_sqrthz, 0, 1,
      "White noise of the gyroscope; a typical MEMS part.");
    v("gyro_walk_radps2_sqrthz", gyro_walk_radps2_sqrthz, 0, 1,
      "Random walk of the gyroscope's bias; a typical MEMS part.");
    v("gyro_initial_bias_radps", gyro_initial_bias_radps, 0, 1,
      "Standard deviation of the bias at the start: what the calibration at rest leaves "
      "(assumed).");
    v("gyro_vibration_radps", gyro_vibration_radps, 0, 10,
      "Standard deviation per sample, at whatever rate (also at the flight controller's 4 kHz), "
      "of what the vibration of flight adds; 0.03 to 0.14 was measured, the low end belongs to a "
      "damped mount.");
    v("gyro_range_radps", gyro_range_radps, 0.1, 1000, "Full scale of the gyroscope: 2000 deg/s.");
    v("accelerometer_density_mps2_sqrthz", accelerometer_density_mps2_sqrthz, 0, 10,
      "White noise of the accelerometer; a typical MEMS part.");
    v("accelerometer_walk_mps3_sqrthz", accelerometer_walk_mps3_sqrthz, 0, 10,
      "Random walk of the accelerometer's bias; a typical MEMS part.");
    v("accelerometer_initial_bias_mps2", accelerometer_initial_bias_mps2, 0, 10,
      "Standard deviation of the accelerometer's bias at the start (assumed).");
    v("accelerometer_vibration_mps2", accelerometer_vibration_mps2, 0, 100,
      "Standard deviation per sample of what the vibration of flight adds (assumed).");
    v("accelerometer_range_mps2", accelerometer_range_mps2, 1, 10000,
      "Full scale of the accelerometer: 16 g.");
  }
};

// Sits at the origin of B, aligned with B. Reading = truth + bias + white noise + vibration,
// limited to the range; densities are those of the continuous noise, discretised exactly.
class Imu {
 public:
  // `name` tells several units of one throw apart: its streams are NAME/gyro/white and so on.
  // Throws ScenarioError if the rate does not fit the ticks.
  Imu(const ImuSpec& spec, std::uint64_t seed, std::uint64_t throw_index,
      std::string_view name = "imu");

  bool due(TimeUs t_us) const { return clock_.due(t_us); }

  // Call at increasing instants.
  ImuReading sample(const Snapshot& truth);

  // Instead of sample() if only the gyroscope is needed: the same w_B_radps, in half the time.
  Eigen::Vector3d sample_gyro(const Snapshot& truth);

 private:
  // One triad of sensors.
  struct Triad {
    Triad(double density, double rate_hz, double vibration, double walk, double initial_bias,
          double range, std::uint64_t seed, std::uint64_t throw_index, const std::string& name);
    Eigen::Vector3d read(const Eigen::Vector3d& truth, double dt_s);

    double white_sigma;
    double vibration_sigma;
    double range;
    RandomStream white;
    RandomStream vibration;
    GaussMarkov<3> bias;
  };

  SampleClock clock_;
  Triad gyro_;
  Triad accelerometer_;
};

}  // namespace dodgesim
