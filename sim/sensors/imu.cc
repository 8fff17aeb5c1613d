#include "sim/sensors/imu.h"

#include <cmath>
#include <string>

#include "sim/base/gravity.h"

namespace dodgesim {

Imu::Triad::Triad(double density, double rate_hz, double vibration, double walk,
                  double initial_bias, double range, std::uint64_t seed, std::uint64_t throw_index,
                  const std::string& name)
    : white_sigma(density * std::sqrt(rate_hz)),
      vibration_sigma(vibration),
      range(range),
      white(seed, throw_index, name + "/white"),
      vibration(seed, throw_index, name + "/vibration"),
      bias(walk, 0, initial_bias, RandomStream(seed, throw_index, name + "/bias")) {}

Eigen::Vector3d Imu::Triad::read(const Eigen::Vector3d& truth, double dt_s) {
  const Eigen::Vector3d value = truth + bias.step(dt_s) + white_sigma * normal_vector<3>(white) +
                                vibration_sigma * normal_vector<3>(vibration);
  return value.cwiseMax(-range).cwiseMin(range);
}

Imu::Imu(const ImuSpec& spec, std::uint64_t seed, std::uint64_t throw_index, std::string_view name)
    : clock_(spec.rate_hz, "IMU"),
      gyro_(spec.gyro_density_radps_sqrthz, spec.rate_hz, spec.gyro_vibration_radps,
            spec.gyro_walk_radps2_sqrthz, spec.gyro_initial_bias_radps, spec.gyro_range_radps, seed,
            throw_index, std::string(name) + "/gyro"),
      accelerometer_(spec.accelerometer_density_mps2_sqrthz, spec.rate_hz,
                     spec.accelerometer_vibration_mps2, spec.accelerometer_walk_mps3_sqrthz,
                     spec.accelerometer_initial_bias_mps2, spec.accelerometer_range_mps2, seed,
                     throw_index, std::string(name) + "/accelerometer") {}

ImuReading Imu::sample(const Snapshot& truth) {
  const double dt_s = clock_.step_s(truth.t_us);
  const Eigen::Quaterniond q_BW = truth.vehicle.q_W.conjugate();
  const Eigen::Vector3d f_W = truth.vehicle_a_W + Eigen::Vector3d(0, 0, kGravityMps2);
  return {truth.t_us, gyro_.read(q_BW * truth.vehicle.w_W, dt_s),
          accelerometer_.read(q_BW * f_W, dt_s)};
}

Eigen::Vector3d Imu::sample_gyro(const Snapshot& truth) {
  return gyro_.read(truth.vehicle.q_W.conjugate() * truth.vehicle.w_W, clock_.step_s(truth.t_us));
}

}  // namespace dodgesim
