#include "dodge/detect/kalman.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "dodge/check_ranges.h"
#include "tests/dodge/generator.h"
#include "tests/dodge/solve.h"

namespace dodge {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Measurement {
  TimeUs t_us;
  Vector3d z;
  Matrix3d R;
};

Matrix3d random_covariance(Generator& random) {
  const Matrix3d rotation = random.rotation();
  const Vector3d sigma = random.uniform_vector(0.01, 0.1);
  return rotation * sigma.cwiseProduct(sigma).asDiagonal() * rotation.transpose();
}

// Irregular times, anisotropic noise.
std::vector<Measurement> random_track(Generator& random, int count) {
  std::vector<Measurement> track;
  TimeUs t_us = 1000000;
  const Vector3d p = random.uniform_vector(-3, 3), v = random.uniform_vector(-8, 8);
  for (int i = 0; i < count; ++i) {
    const Matrix3d R = random_covariance(random);
    const double t = seconds(t_us - 1000000);
    const Vector3d noise = R.llt().matrixL() * random.normal_vector();
    track.push_back({t_us, p + v * t + noise, R});
    t_us += 1000 + static_cast<TimeUs>(random.bits() % 9000);
  }
  return track;
}

Kalman filtered(const KalmanConfig& config, const std::vector<Measurement>& track) {
  Kalman filter(config, track.front().t_us, track.front().z, track.front().R);
  for (std::size_t i = 1; i < track.size(); ++i) {
    filter.update(track[i].t_us, track[i].z, track[i].R);
  }
  return filter;
}

TEST(Kalman, AgreesWithBatchLeastSquaresWithoutProcessNoise) {
  Generator random(1);
  KalmanConfig config;
  config.acceleration_noise_mps2_sqrthz = 0;
  for (int k = 0; k < 50; ++k) {
    const std::vector<Measurement> track = random_track(random, 2 + k % 20);
    // Information form: state at the last instant, prior on the velocity only.
    Matrix6d information = Matrix6d::Zero();
    Vector6d right = Vector6d::Zero();
    information.bottomRightCorner<3, 3>() =
        Matrix3d::Identity() / std::pow(config.initial_speed_sigma_mps, 2);
    for (const Measurement& m : track) {
      const double back = seconds(m.t_us - track.back().t_us);
      Eigen::Matrix<double, 3, 6> H;
      H << Matrix3d::Identity(), back * Matrix3d::Identity();
      information += H.transpose() * m.R.inverse() * H;
      right += H.transpose() * m.R.inverse() * m.z;
    }
    const Vector6d x = solve(information, right);
    const Kalman filter = filtered(config, track);
    EXPECT_TRUE(filter.position().isApprox(x.head<3>(), 1e-8));
    EXPECT_TRUE(filter.velocity().isApprox(x.tail<3>(), 1e-7));
    EXPECT_TRUE(filter.covariance().isApprox(solve(information, Matrix6d::Identity()), 1e-6));
  }
}

TEST(Kalman, AgreesWithJointGaussianConditioningWithProcessNoise) {
  // All measurements and the last state as one Gaussian vector: the kernel of twice integrated
  // white noise, without any recursion.
  Generator random(2);
  const KalmanConfig config;
  const double q = config.acceleration_noise_mps2_sqrthz * config.acceleration_noise_mps2_sqrthz;
  for (int k = 0; k < 20; ++k) {
    const std::vector<Measurement> track = random_track(random, 2 + k);
    const auto n = static_cast<Eigen::Index>(track.size());
    const auto time = [&](Eigen::Index i) {
      return seconds(track[static_cast<std::size_t>(i)].t_us - track.front().t_us);
    };
    // The first position is diffuse; a wide prior stands in for it.
    constexpr double kWide = 1e4;
    const double speed_variance = std::pow(config.initial_speed_sigma_mps, 2);
    const auto position_covariance = [&](double s, double t) {
      const double a = std::min(s, t), b = std::max(s, t);
      return kWide + speed_variance * s * t + q * (a * a * b / 2 - a * a * a / 6);
    };
    const double T = time(n - 1);
    Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    Eigen::MatrixXd cross = Eigen::MatrixXd::Zero(6, 3 * n);
    Eigen::VectorXd z(3 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Measurement& m = track[static_cast<std::size_t>(i)];
      z.segment<3>(3 * i) = m.z;
      for (Eigen::Index j = 0; j < n; ++j) {
        Z.block<3, 3>(3 * i, 3 * j) = position_covariance(time(i), time(j)) * Matrix3d::Identity();
      }
      Z.block<3, 3>(3 * i, 3 * i) += m.R;
      const double t = time(i);
      cross.block<3, 3>(0, 3 * i) = position_covariance(T, t) * Matrix3d::Identity();
      cross.block<3, 3>(3, 3 * i) = (speed_variance * t + q * t * t / 2) * Matrix3d::Identity();
    }
    const Vector6d x = cross * solve(Z, z);
    const Kalman filter = filtered(config, track);
    EXPECT_TRUE(filter.position().isApprox(x.head<3>(), 1e-4)) << k;
    EXPECT_LT((filter.velocity() - x.tail<3>()).norm(), 1e-2) << k;
  }
}

TEST(Kalman, TakesMeasurementsInAnyOrderWithoutProcessNoise) {
  Generator random(6);
  KalmanConfig config;
  config.acceleration_noise_mps2_sqrthz = 0;
  for (int k = 0; k < 50; ++k) {
    config.gravity = k % 2 == 0;
    std::vector<Measurement> track = random_track(random, 12);
    const Kalman in_order = filtered(config, track);
    std::swap(track[3], track[4]);  // a late one
    std::swap(track[8], track[10]);
    const Kalman late = filtered(config, track);
    EXPECT_EQ(late.t_us(), in_order.t_us());
    EXPECT_TRUE(late.position().isApprox(in_order.position(), 1e-9)) << k;
    EXPECT_TRUE(late.velocity().isApprox(in_order.velocity(), 1e-9)) << k;
    EXPECT_TRUE(late.covariance().isApprox(in_order.covariance(), 1e-9)) << k;
  }
}

TEST(Kalman, KnowsWhereTheObstacleWas) {
  KalmanConfig config;
  config.gravity = true;
  const Vector3d p(3, 0.2, 1);
  const Kalman filter(config, 0, p, 0.01 * Matrix3d::Identity());
  for (const TimeUs t_us : {-20000, 0, 20000}) {
    const Kalman::Position at = filter.position_at(t_us);
    const double t = seconds(t_us);
    EXPECT_TRUE(at.mean_W.isApprox(p - 0.5 * kGravityMps2 * t * t * Vector3d::UnitZ(), 1e-12));
    // Its speed has a standard deviation of 6 m/s; only the future has process noise.
    const double noise = t > 0 ? 9 * t * t * t / 3 : 0;
    EXPECT_NEAR(at.covariance_W(2, 2), 0.01 + 36 * t * t + noise, 1e-12);
  }
}

TEST(Kalman, ConvergesToAConstantVelocity) {
  Generator random(3);
  KalmanConfig config;
  config.acceleration_noise_mps2_sqrthz = 0;
  const Vector3d p(3, 0.2, 1), v(-6, 0.5, 1);
  const Matrix3d R = 0.02 * 0.02 * Matrix3d::Identity();
  Kalman filter(config, 0, p + 0.02 * random.normal_vector(), R);
  for (TimeUs t_us = 2000; t_us <= 400000; t_us += 2000) {
    filter.update(t_us, p + v * seconds(t_us) + 0.02 * random.normal_vector(), R);
  }
  // 201 measurements over 0.4 s: sigma_v = 0.02 sqrt(12 / 201) / 0.4 = 0.012 m/s.
  EXPECT_NEAR(std::sqrt(filter.covariance()(3, 3)), 0.012, 0.001);
  EXPECT_LT((filter.velocity() - v).norm(), 0.05);
  EXPECT_LT((filter.position() - (p + 0.4 * v)).norm(), 0.015);
}

TEST(Kalman, StatesItsErrorsHonestly) {
  // The normalised estimation error squared over many tracks whose truth follows the model: mean 6,
  // standard deviation of the mean sqrt(12 / count).
  const KalmanConfig config;
  constexpr int kTracks = 2000;
  double sum = 0;
  for (int seed = 0; seed < kTracks; ++seed) {
    Generator random(static_cast<std::uint64_t>(seed) + 1000);
    Vector3d p = random.uniform_vector(-3, 3);
    Vector3d v = config.initial_speed_sigma_mps * random.normal_vector();
    TimeUs t_us = 0;
    Matrix3d R = random_covariance(random);
    Kalman filter(config, 0, p + R.llt().matrixL() * random.normal_vector(), R);
    for (int i = 0; i < 20; ++i) {
      // White acceleration, in steps much finer than the filter's.
      const int steps = 5 + static_cast<int>(random.bits() % 20);
      constexpr TimeUs kStepUs = 400;
      constexpr double dt = seconds(kStepUs);
      for (int s = 0; s < steps; ++s) {
        const Vector3d dv =
            config.acceleration_noise_mps2_sqrthz * std::sqrt(dt) * random.normal_vector();
        p += dt * (v + 0.5 * dv);
        v += dv;
      }
      t_us += steps * kStepUs;
      R = random_covariance(random);
      filter.update(t_us, p + R.llt().matrixL() * random.normal_vector(), R);
    }
    Vector6d error;
    error << filter.position() - p, filter.velocity() - v;
    sum += error.dot(Vector6d(solve(filter.covariance(), error)));
  }
  EXPECT_NEAR(sum / kTracks, 6, 4 * std::sqrt(12.0 / kTracks));
}

TEST(Kalman, KeepsItsCovarianceSymmetricAndPositiveDefinite) {
  Generator random(4);
  for (const double noise : {0.0, 3.0}) {
    KalmanConfig config;
    config.acceleration_noise_mps2_sqrthz = noise;
    Kalman filter(config, 0, Vector3d::Zero(), Matrix3d::Identity());
    TimeUs t_us = 0;
    for (int i = 0; i < 20000; ++i) {
      t_us += random.bits() % 5 == 0 ? 0 : static_cast<TimeUs>(random.bits() % 3000);
      const double sigma = std::pow(10.0, random.uniform(-4, 1));
      filter.update(t_us, random.normal_vector(), sigma * sigma * Matrix3d::Identity());
      const Matrix6d& P = filter.covariance();
      ASSERT_EQ((P - P.transpose()).norm(), 0);
      ASSERT_EQ(P.llt().info(), Eigen::Success) << i;
    }
  }
}

TEST(Kalman, PredictsInOneStepAsInMany) {
  Generator random(5);
  const std::vector<Measurement> track = random_track(random, 10);
  for (const bool gravity : {false, true}) {
    KalmanConfig config;
    config.gravity = gravity;
    Kalman once = filtered(config, track), often = once;
    const TimeUs start = once.t_us();
    once.predict(start + 50000);
    for (TimeUs t_us = start; t_us <= start + 50000; t_us += 1000) often.predict(t_us);
    EXPECT_TRUE(once.position().isApprox(often.position(), 1e-12));
    EXPECT_TRUE(once.covariance().isApprox(often.covariance(), 1e-9));
  }
}

TEST(Kalman, FallsFreelyOnlyWhereAsked) {
  for (const bool gravity : {false, true}) {
    KalmanConfig config;
    config.gravity = gravity;
    Kalman filter(config, 0, Vector3d(1, 2, 3), Matrix3d::Identity());
    filter.predict(500000);
    EXPECT_NEAR(filter.position().z(), gravity ? 3 - 0.5 * 9.81 * 0.25 : 3, 1e-12);
    EXPECT_NEAR(filter.velocity().z(), gravity ? -9.81 * 0.5 : 0, 1e-12);
  }
}

TEST(Kalman, DoesNotPredictIntoThePast) {
  Kalman filter({}, 1000, Vector3d(1, 2, 3), Matrix3d::Identity());
  const Matrix6d before = filter.covariance();
  filter.predict(500);
  EXPECT_EQ(filter.t_us(), 1000);
  EXPECT_EQ(filter.covariance(), before);
}

TEST(MeasurementCovariance, LiesAlongTheLineOfSight) {
  KalmanConfig config;
  config.lateral_sigma_m = 0.02;
  config.min_depth_sigma_m = 0.03;
  Detection detection;
  const Vector3d sight = Vector3d(1, 2, 2) / 3, across = Vector3d(2, 1, -2) / 3;
  detection.p_W.fill(Vector3d::Zero());
  detection.p_W[4] = -0.2 * sight;
  detection.p_W[5] = 0.2 * sight;
  detection.depth_sigma_m = 0.1;
  Matrix3d R = measurement_covariance(config, detection);
  EXPECT_NEAR(sight.dot(R * sight), 0.01, 1e-12);
  EXPECT_NEAR(across.dot(R * across), 0.0004, 1e-12);
  EXPECT_NEAR(sight.dot(R * across), 0, 1e-12);
  detection.depth_sigma_m = 0;
  R = measurement_covariance(config, detection);
  EXPECT_NEAR(sight.dot(R * sight), 0.0009, 1e-12);
  detection.p_W[5] = detection.p_W[4];
  detection.depth_sigma_m = 0.1;
  EXPECT_TRUE(measurement_covariance(config, detection).isApprox(0.01 * Matrix3d::Identity()));
}

TEST(MeasurementCovariance, IsLongerThanTheDepthsTowardsTheEdgesOfTheView) {
  Detection detection;
  detection.p_W.fill(Vector3d::Zero());
  const Vector3d ray(0.8, 0.6, 1);  // of depth 1, seen from a camera that looks along z
  detection.p_W[5] = ray;
  detection.depth_sigma_m = 0.1;
  detection.distance_per_depth = ray.norm();
  // Depth z alone is uncertain: p = z ray.
  const Vector3d sight = ray.normalized();
  const Matrix3d R = measurement_covariance({}, detection);
  EXPECT_NEAR(sight.dot(R * sight), (0.1 * ray).squaredNorm(), 1e-12);
}

TEST(MeasurementCovariance, GrowsWithTheClusterAcrossTheLineOfSight) {
  KalmanConfig config;
  config.lateral_sigma_m = 0.03;
  config.lateral_size_share = 0.1;
  Detection detection;
  detection.p_W.fill(Vector3d::Zero());
  detection.p_W[5] = Vector3d::UnitX();
  detection.depth_sigma_m = 0.1;
  detection.size_m = 0.4;
  const Vector3d variances = measurement_covariance(config, detection).diagonal();
  EXPECT_NEAR(variances.x(), 0.01, 1e-12);
  EXPECT_NEAR(variances.y(), 0.0025, 1e-12);
  EXPECT_NEAR(variances.z(), 0.0025, 1e-12);
}

TEST(KalmanConfig, RefusesWhatIsNotADeviation) {
  const auto refused = [](auto change) {
    KalmanConfig config;
    change(config);
    EXPECT_THROW(check_ranges(config), std::invalid_argument);
  };
  refused([](KalmanConfig& c) { c.acceleration_noise_mps2_sqrthz = -1; });
  refused([](KalmanConfig& c) { c.initial_speed_sigma_mps = 0; });
  refused([](KalmanConfig& c) { c.lateral_sigma_m = std::nan(""); });
  refused([](KalmanConfig& c) { c.min_depth_sigma_m = 0; });
  refused([](KalmanConfig& c) { c.lateral_size_share = -0.1; });
}

}  // namespace
}  // namespace dodge
