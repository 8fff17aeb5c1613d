#include "sim/sensors/state_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

StateEstimateSpec noiseless_estimate() {
  StateEstimateSpec spec;
  spec.position_walk_m_sqrts = 0;
  spec.position_white_m = 0;
  spec.velocity_bias_mps = 0;
  spec.velocity_white_mps = 0;
  spec.yaw_walk_rad_sqrts = 0;
  spec.tilt_error_rad = 0;
  spec.attitude_white_rad = 0;
  spec.rate_white_radps = 0;
  return spec;
}

Snapshot some_truth() {
  Snapshot truth;
  truth.t_us = 8000;
  truth.vehicle.p_W = Vector3d(1, 2, 3);
  truth.vehicle.q_W = Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5);
  truth.vehicle.v_W = Vector3d(-1, 4, 2);
  truth.vehicle.w_W = Vector3d(1, 2, 3);
  return truth;
}

// Rotation vector of the attitude's error, in W.
Vector3d attitude_error(const StateReading& reading, const Snapshot& truth) {
  const Eigen::AngleAxisd error(reading.q_W * truth.vehicle.q_W.conjugate());
  return error.angle() * error.axis();
}

TEST(StateEstimator, WithoutErrorsItTellsTheTruth) {
  StateEstimator estimator(noiseless_estimate(), 1, 0);
  const Snapshot truth = some_truth();
  const StateReading reading = estimator.sample(truth);
  EXPECT_EQ(reading.t_us, truth.t_us);
  EXPECT_TRUE(reading.p_W.isApprox(truth.vehicle.p_W, 1e-12));
  EXPECT_TRUE(reading.v_W.isApprox(truth.vehicle.v_W, 1e-12));
  EXPECT_NEAR(reading.q_W.angularDistance(truth.vehicle.q_W), 0, 1e-7);
  // This attitude turns body x to world y, y to z, z to x.
  EXPECT_TRUE(reading.w_B.isApprox(Vector3d(2, 3, 1), 1e-12));
}

TEST(StateEstimator, PositionAndYawDriftWithoutBoundAsTheirDensitiesSay) {
  StateEstimateSpec spec = noiseless_estimate();
  spec.position_walk_m_sqrts = 0.02;
  spec.yaw_walk_rad_sqrts = 0.01;
  constexpr int kRuns = 2000;
  constexpr double kTimeS = 4;
  double position = 0, yaw = 0, tilt = 0;
  for (int n = 0; n < kRuns; ++n) {
    StateEstimator estimator(spec, 1, static_cast<std::uint64_t>(n));
    Snapshot truth;
    StateReading reading = estimator.sample(truth);
    EXPECT_NEAR(reading.p_W.norm(), 0, 1e-12);
    for (int i = 0; i < 8; ++i) {
      truth.t_us += 500000;
      reading = estimator.sample(truth);
    }
    const Vector3d error = attitude_error(reading, truth);
    position += reading.p_W.squaredNorm() / (3 * kRuns);
    yaw += error.z() * error.z() / kRuns;
    tilt += error.head<2>().squaredNorm() / kRuns;
  }
  EXPECT_NEAR(position / (0.02 * 0.02 * kTimeS), 1, 4 * std::sqrt(2.0 / (3 * kRuns)));
  EXPECT_NEAR(yaw / (0.01 * 0.01 * kTimeS), 1, 4 * std::sqrt(2.0 / kRuns));
  EXPECT_NEAR(tilt, 0, 1e-12);
}

TEST(StateEstimator, TheHeightDriftsFromItsStartOnAndTheVelocityWithIt) {
  StateEstimateSpec spec = noiseless_estimate();
  spec.height_drift_mps = -0.2;
  spec.height_drift_start_s = 2;
  StateEstimator estimator(spec, 1, 0);
  Snapshot truth;
  truth.vehicle.p_W = Vector3d(1, 2, 3);
  truth.vehicle.v_W = Vector3d(0, 1, 0.5);
  Vector3d last_error = Vector3d::Zero();
  for (truth.t_us = 0; truth.t_us <= 5000000; truth.t_us += 500000) {
    const StateReading reading = estimator.sample(truth);
    const double drifting_s = std::max(0.0, seconds(truth.t_us) - 2);
    const Vector3d error = reading.p_W - truth.vehicle.p_W;
    EXPECT_TRUE(error.isApprox(Vector3d(0, 0, -0.2 * drifting_s), 1e-12)) << truth.t_us;
    // An odometry's position is the sum of its velocities.
    if (truth.t_us > 2000000) {
      EXPECT_NEAR(reading.v_W.z() - 0.5, (error - last_error).z() / 0.5, 1e-12);
    } else {
      EXPECT_EQ(reading.v_W, truth.vehicle.v_W);
    }
    last_error = error;
  }
}

TEST(StateEstimator, ItsFrameDriftsByWhatItsPositionIsOffWithoutTheWhiteNoise) {
  StateEstimateSpec spec = noiseless_estimate();
  spec.position_walk_m_sqrts = 0.1;
  spec.height_drift_mps = 0.3;
  spec.height_drift_start_s = 1;
  StateEstimator estimator(spec, 1, 0);
  Snapshot truth = some_truth();
  for (truth.t_us = 0; truth.t_us <= 3000000; truth.t_us += 500000) {
    const StateReading reading = estimator.sample(truth);
    EXPECT_TRUE(estimator.drift().p_W.isApprox(reading.p_W - truth.vehicle.p_W, 1e-12));
    EXPECT_NEAR((estimator.drift().v_W - (reading.v_W - truth.vehicle.v_W)).norm(), 0, 1e-12);
  }
  EXPECT_GT(estimator.drift().p_W.head<2>().norm(), 0.01);

  spec.position_white_m = spec.velocity_white_mps = 1;
  StateEstimator noisy(spec, 1, 0);
  for (truth.t_us = 0; truth.t_us <= 3000000; truth.t_us += 500000) noisy.sample(truth);
  EXPECT_EQ(noisy.drift().p_W, estimator.drift().p_W);
  EXPECT_EQ(noisy.drift().v_W, estimator.drift().v_W);
}

TEST(StateEstimator, VelocityAndTiltErrorsAreStationaryAndForgetThemselves) {
  StateEstimateSpec spec = noiseless_estimate();
  spec.velocity_bias_mps = 0.05;
  spec.velocity_bias_correlation_s = 0.8;
  spec.tilt_error_rad = 0.01;
  spec.tilt_error_correlation_s = 2;
  constexpr int kRuns = 3000;
  constexpr int kSteps = 125;
  constexpr TimeUs kPeriodUs = 4000;
  double v_start = 0, v_end = 0, v_product = 0, tilt_end = 0, tilt_product = 0;
  for (int n = 0; n < kRuns; ++n) {
    StateEstimator estimator(spec, 1, static_cast<std::uint64_t>(n));
    Snapshot truth;
    truth.vehicle.q_W = some_truth().vehicle.q_W;
    const StateReading start = estimator.sample(truth);
    StateReading end;
    for (int i = 0; i < kSteps; ++i) {
      truth.t_us += kPeriodUs;
      end = estimator.sample(truth);
    }
    v_start += start.v_W.squaredNorm() / (3 * kRuns);
    v_end += end.v_W.squaredNorm() / (3 * kRuns);
    v_product += start.v_W.dot(end.v_W) / (3 * kRuns);
    const Vector3d tilt = attitude_error(end, truth);
    tilt_end += tilt.squaredNorm() / (2 * kRuns);
    tilt_product += tilt.dot(attitude_error(start, truth)) / (2 * kRuns);
    EXPECT_NEAR(tilt.z(), 0, 1e-9);  // about the world's axes, however the vehicle is turned
  }
  const double time_s = seconds(kPeriodUs) * kSteps;
  EXPECT_NEAR(v_start / (0.05 * 0.05), 1, 4 * std::sqrt(2.0 / (3 * kRuns)));
  EXPECT_NEAR(v_end / (0.05 * 0.05), 1, 4 * std::sqrt(2.0 / (3 * kRuns)));
  EXPECT_NEAR(v_product / (0.05 * 0.05), std::exp(-time_s / 0.8), 4 * std::sqrt(2.0 / (3 * kRuns)));
  EXPECT_NEAR(tilt_end / (0.01 * 0.01), 1, 4 * std::sqrt(2.0 / (2 * kRuns)));
  EXPECT_NEAR(tilt_product / (0.01 * 0.01), std::exp(-time_s / 2),
              4 * std::sqrt(2.0 / (2 * kRuns)));
}

TEST(StateEstimator, WhiteNoiseHasItsSizeAndNoMemory) {
  StateEstimateSpec spec = noiseless_estimate();
  spec.position_white_m = 0.002;
  spec.velocity_white_mps = 0.01;
  spec.attitude_white_rad = 0.001;
  spec.rate_white_radps = 0.02;
  StateEstimator estimator(spec, 1, 0);
  constexpr int kSamples = 10000;
  double p = 0, v = 0, q = 0, w = 0, lagged = 0;
  Vector3d last = Vector3d::Zero();
  Snapshot truth;
  for (int n = 0; n < kSamples; ++n, truth.t_us += 4000) {
    const StateReading reading = estimator.sample(truth);
    p += reading.p_W.squaredNorm() / (3 * kSamples);
    v += reading.v_W.squaredNorm() / (3 * kSamples);
    q += attitude_error(reading, truth).squaredNorm() / (3 * kSamples);
    w += reading.w_B.squaredNorm() / (3 * kSamples);
    lagged += reading.v_W.dot(last) / (3 * kSamples);
    last = reading.v_W;
  }
  const double four_sigma = 4 * std::sqrt(2.0 / (3 * kSamples));
  EXPECT_NEAR(p / (0.002 * 0.002), 1, four_sigma);
  EXPECT_NEAR(v / (0.01 * 0.01), 1, four_sigma);
  EXPECT_NEAR(q / (0.001 * 0.001), 1, four_sigma);
  EXPECT_NEAR(w / (0.02 * 0.02), 1, four_sigma);
  EXPECT_NEAR(lagged / (0.01 * 0.01), 0, four_sigma);
}

// The estimated velocity seen from the estimated heading is the true one seen from the true
// heading.
TEST(StateEstimator, HeadingErrorTurnsTheVelocityWithIt) {
  StateEstimateSpec spec = noiseless_estimate();
  spec.yaw_walk_rad_sqrts = 0.3;
  StateEstimator estimator(spec, 1, 0);
  Snapshot truth = some_truth();
  estimator.sample(truth);
  truth.t_us += 1000000;
  const StateReading reading = estimator.sample(truth);
  EXPECT_GT(reading.q_W.angularDistance(truth.vehicle.q_W), 0.01);
  EXPECT_TRUE((reading.q_W.conjugate() * reading.v_W)
                  .isApprox(truth.vehicle.q_W.conjugate() * truth.vehicle.v_W, 1e-12));
}

TEST(StateEstimator, RepeatsForTheSameThrowAndItsStreamsAreIndependent) {
  const Snapshot truth = some_truth();
  const StateReading reading = StateEstimator(StateEstimateSpec(), 3, 5).sample(truth);
  const StateReading again = StateEstimator(StateEstimateSpec(), 3, 5).sample(truth);
  EXPECT_EQ(again.p_W, reading.p_W);
  EXPECT_EQ(again.q_W.coeffs(), reading.q_W.coeffs());
  EXPECT_NE(StateEstimator(StateEstimateSpec(), 3, 6).sample(truth).p_W, reading.p_W);

  StateEstimateSpec without_bias;
  without_bias.velocity_bias_mps = 0;
  const StateReading other = StateEstimator(without_bias, 3, 5).sample(truth);
  EXPECT_NE(other.v_W, reading.v_W);
  EXPECT_EQ(other.p_W, reading.p_W);
  EXPECT_EQ(other.w_B, reading.w_B);
}

TEST(StateEstimator, IsDueAtItsRate) {
  const StateEstimator estimator(StateEstimateSpec(), 1, 0);
  EXPECT_TRUE(estimator.due(0));
  EXPECT_FALSE(estimator.due(2000));
  EXPECT_TRUE(estimator.due(4000));
  StateEstimateSpec odd;
  odd.rate_hz = 240;
  EXPECT_THROW(StateEstimator(odd, 1, 0), ScenarioError);
}

}  // namespace
}  // namespace dodgesim
