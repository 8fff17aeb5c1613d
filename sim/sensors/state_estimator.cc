#include "sim/sensors/state_estimator.h"

#include "sim/base/rotation.h"

namespace dodgesim {

StateEstimator::StateEstimator(const StateEstimateSpec& spec, std::uint64_t seed,
                               std::uint64_t throw_index)
    : spec_(spec),
      clock_(spec.rate_hz, "state estimate"),
      position_walk_(spec.position_walk_m_sqrts, 0, 0,
                     RandomStream(seed, throw_index, "state/position/walk")),
      velocity_bias_(
          GaussMarkov<3>::stationary(spec.velocity_bias_mps, spec.velocity_bias_correlation_s,
                                     RandomStream(seed, throw_index, "state/velocity/bias"))),
      yaw_walk_(spec.yaw_walk_rad_sqrts, 0, 0, RandomStream(seed, throw_index, "state/yaw/walk")),
      tilt_error_(GaussMarkov<2>::stationary(spec.tilt_error_rad, spec.tilt_error_correlation_s,
                                             RandomStream(seed, throw_index, "state/tilt/error"))),
      position_white_(seed, throw_index, "state/position/white"),
      velocity_white_(seed, throw_index, "state/velocity/white"),
      attitude_white_(seed, throw_index, "state/attitude/white"),
      rate_white_(seed, throw_index, "state/rate/white") {}

void StateEstimator::step_drift(TimeUs t_us, double dt_s) {
  drift_.p_W = position_walk_.step(dt_s);
  const double drifting_s = seconds(t_us) - spec_.height_drift_start_s;
  if (drifting_s <= 0) return;
  drift_.p_W.z() += spec_.height_drift_mps * drifting_s;
  drift_.v_W.z() = spec_.height_drift_mps;
}

StateReading StateEstimator::sample(const Snapshot& truth) {
  const double dt_s = clock_.step_s(truth.t_us);
  step_drift(truth.t_us, dt_s);
  const Eigen::Quaterniond yaw_error = rotation(Eigen::Vector3d(0, 0, yaw_walk_.step(dt_s)[0]));
  const Eigen::Vector2d tilt = tilt_error_.step(dt_s);
  const Eigen::Quaterniond tilt_error =
      rotation(Eigen::Vector3d(tilt.x(), tilt.y(), 0) +
               spec_.attitude_white_rad * normal_vector<3>(attitude_white_));

  StateReading reading;
  reading.t_us = truth.t_us;
  reading.p_W =
      truth.vehicle.p_W + drift_.p_W + spec_.position_white_m * normal_vector<3>(position_white_);
  reading.q_W = (tilt_error * yaw_error * truth.vehicle.q_W).normalized();
  reading.v_W = yaw_error * truth.vehicle.v_W + drift_.v_W + velocity_bias_.step(dt_s) +
                spec_.velocity_white_mps * normal_vector<3>(velocity_white_);
  reading.w_B = truth.vehicle.q_W.conjugate() * truth.vehicle.w_W +
                spec_.rate_white_radps * normal_vector<3>(rate_white_);
  return reading;
}

}  // namespace dodgesim
