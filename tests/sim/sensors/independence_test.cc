// No two of the noises of a vehicle's sensors are the same, or have anything to do with each other.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/gravity.h"
#include "sim/sensors/imu.h"
#include "sim/sensors/range_sensor.h"
#include "sim/sensors/state_estimator.h"

namespace dodgesim {
namespace {

constexpr int kThrows = 1500;
constexpr int kSamples = 4;
constexpr TimeUs kPeriodUs = 1000000;

// One row a throw: all components of the errors of its samples, over their standard deviations.
using Noise = Eigen::MatrixXd;

// `errors(throw_index)` samples a sensor of its own at kSamples instants.
Noise noise_of(const std::function<Eigen::VectorXd(std::uint64_t)>& errors) {
  Noise noise(kThrows, errors(0).size());
  for (int k = 0; k < kThrows; ++k) noise.row(k) = errors(static_cast<std::uint64_t>(k));
  for (Eigen::Index i = 0; i < noise.cols(); ++i) {
    const double sigma = noise.col(i).norm() / std::sqrt(kThrows);
    if (sigma > 1e-9) noise.col(i) /= sigma;  // a walk has not started to walk at first
  }
  return noise;
}

template <class Sample>
Eigen::VectorXd samples(Sample sample) {
  std::vector<double> errors;
  Snapshot truth;
  for (int i = 0; i < kSamples; ++i, truth.t_us += kPeriodUs) {
    for (const double error : sample(truth)) errors.push_back(error);
  }
  return Eigen::Map<Eigen::VectorXd>(errors.data(), static_cast<Eigen::Index>(errors.size()));
}

// Of a state estimate with one kind of error only.
Noise estimate_noise(double StateEstimateSpec::*size) {
  StateEstimateSpec spec;
  for (double StateEstimateSpec::*each :
       {&StateEstimateSpec::position_walk_m_sqrts, &StateEstimateSpec::position_white_m,
        &StateEstimateSpec::velocity_bias_mps, &StateEstimateSpec::velocity_white_mps,
        &StateEstimateSpec::yaw_walk_rad_sqrts, &StateEstimateSpec::tilt_error_rad,
        &StateEstimateSpec::attitude_white_rad, &StateEstimateSpec::rate_white_radps}) {
    spec.*each = each == size ? 1e-3 : 0;
  }
  return noise_of([&](std::uint64_t throw_index) {
    StateEstimator estimator(spec, 1, throw_index);
    return samples([&](const Snapshot& truth) {
      const StateReading reading = estimator.sample(truth);
      Eigen::Matrix<double, 12, 1> error;
      error << reading.p_W, reading.v_W, 2 * reading.q_W.vec(), reading.w_B;
      return error;
    });
  });
}

Noise imu_noise(const char* name, double ImuSpec::*size) {
  ImuSpec spec;
  for (double ImuSpec::*each :
       {&ImuSpec::gyro_density_radps_sqrthz, &ImuSpec::gyro_initial_bias_radps,
        &ImuSpec::gyro_walk_radps2_sqrthz, &ImuSpec::gyro_vibration_radps,
        &ImuSpec::accelerometer_density_mps2_sqrthz, &ImuSpec::accelerometer_initial_bias_mps2,
        &ImuSpec::accelerometer_walk_mps3_sqrthz, &ImuSpec::accelerometer_vibration_mps2}) {
    spec.*each = each == size ? 1e-3 : 0;
  }
  return noise_of([&](std::uint64_t throw_index) {
    Imu imu(spec, 1, throw_index, name);
    return samples([&](const Snapshot& truth) {
      const ImuReading reading = imu.sample(truth);
      Eigen::Matrix<double, 6, 1> error;
      error << reading.w_B_radps, reading.f_B_mps2 - Eigen::Vector3d(0, 0, kGravityMps2);
      return error;
    });
  });
}

Noise range_noise() {
  RangeSpec spec;
  spec.resolution_m = 0;
  return noise_of([&](std::uint64_t throw_index) {
    RangeSensor sensor(spec, 1, throw_index);
    return samples([&](const Snapshot& truth) {
      return Eigen::Matrix<double, 1, 1>(sensor.sample(truth.t_us, 2)->range_m - 2);
    });
  });
}

TEST(NoiseOfTheSensors, IsIndependentOfThatOfAllOthers) {
  std::vector<std::pair<std::string, Noise>> noises = {
      {"position walk", estimate_noise(&StateEstimateSpec::position_walk_m_sqrts)},
      {"position white", estimate_noise(&StateEstimateSpec::position_white_m)},
      {"velocity bias", estimate_noise(&StateEstimateSpec::velocity_bias_mps)},
      {"velocity white", estimate_noise(&StateEstimateSpec::velocity_white_mps)},
      {"yaw walk", estimate_noise(&StateEstimateSpec::yaw_walk_rad_sqrts)},
      {"tilt error", estimate_noise(&StateEstimateSpec::tilt_error_rad)},
      {"attitude white", estimate_noise(&StateEstimateSpec::attitude_white_rad)},
      {"rate white", estimate_noise(&StateEstimateSpec::rate_white_radps)},
      {"range", range_noise()}};
  for (const char* name : {"imu", "flight_controller_imu"}) {
    const std::string of = std::string(" of ") + name;
    noises.emplace_back("gyro white" + of, imu_noise(name, &ImuSpec::gyro_density_radps_sqrthz));
    noises.emplace_back("gyro bias" + of, imu_noise(name, &ImuSpec::gyro_initial_bias_radps));
    noises.emplace_back("gyro vibration" + of, imu_noise(name, &ImuSpec::gyro_vibration_radps));
    noises.emplace_back("accelerometer white" + of,
                        imu_noise(name, &ImuSpec::accelerometer_density_mps2_sqrthz));
    noises.emplace_back("accelerometer bias" + of,
                        imu_noise(name, &ImuSpec::accelerometer_initial_bias_mps2));
    noises.emplace_back("accelerometer vibration" + of,
                        imu_noise(name, &ImuSpec::accelerometer_vibration_mps2));
  }
  // Six standard deviations, as correlations of components are many thousands.
  for (std::size_t i = 0; i < noises.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double most =
          (noises[i].second.transpose() * noises[j].second / kThrows).cwiseAbs().maxCoeff();
      if (i == j) {
        EXPECT_NEAR(most, 1, 1e-9) << noises[i].first;  // there is noise
      } else {
        EXPECT_LT(most, 6 / std::sqrt(kThrows)) << noises[i].first << ", " << noises[j].first;
      }
    }
  }
}

}  // namespace
}  // namespace dodgesim
