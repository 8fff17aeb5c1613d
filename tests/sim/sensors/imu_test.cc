#include "sim/sensors/imu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/base/error.h"
#include "sim/base/gravity.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

ImuSpec noiseless_imu() {
  ImuSpec spec;
  spec.gyro_density_radps_sqrthz = 0;
  spec.gyro_walk_radps2_sqrthz = 0;
  spec.gyro_initial_bias_radps = 0;
  spec.gyro_vibration_radps = 0;
  spec.accelerometer_density_mps2_sqrthz = 0;
  spec.accelerometer_walk_mps3_sqrthz = 0;
  spec.accelerometer_initial_bias_mps2 = 0;
  spec.accelerometer_vibration_mps2 = 0;
  return spec;
}

TEST(Imu, MeasuresGravityUpwardsAtRestAndNothingInFreeFall) {
  Imu imu(noiseless_imu(), 1, 0);
  Snapshot truth;
  EXPECT_TRUE(imu.sample(truth).f_B_mps2.isApprox(Vector3d(0, 0, kGravityMps2)));
  truth.vehicle_a_W = Vector3d(0, 0, -kGravityMps2);
  EXPECT_NEAR(imu.sample(truth).f_B_mps2.norm(), 0, 1e-12);
}

TEST(Imu, WithoutNoiseItReadsTheTruthInTheBodyFrame) {
  Imu imu(noiseless_imu(), 1, 0);
  Snapshot truth;
  truth.t_us = 5000;
  // Nose up by 90 deg: x_B along z_W, z_B along -x_W.
  truth.vehicle.q_W = Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitY());
  truth.vehicle.w_W = Vector3d(1, 2, 3);
  truth.vehicle_a_W = Vector3d(4, 5, 6);
  const ImuReading reading = imu.sample(truth);
  EXPECT_EQ(reading.t_us, 5000);
  EXPECT_TRUE(reading.w_B_radps.isApprox(Vector3d(3, 2, -1), 1e-12));
  EXPECT_TRUE(reading.f_B_mps2.isApprox(Vector3d(6 + kGravityMps2, 5, -4), 1e-12));
}

TEST(Imu, WhiteNoiseHasTheVarianceOfItsDensityAtTheRate) {
  for (int rate_hz : {250, 1000}) {
    ImuSpec spec = noiseless_imu();
    spec.rate_hz = rate_hz;
    spec.gyro_density_radps_sqrthz = 1.75e-4;
    spec.accelerometer_density_mps2_sqrthz = 2e-3;
    Imu imu(spec, 1, 0);
    constexpr int kSamples = 10000;
    double gyro = 0, accelerometer = 0, lagged = 0, last = 0;
    Snapshot truth;
    for (int n = 0; n < kSamples; ++n, truth.t_us += 1000000 / rate_hz) {
      const ImuReading reading = imu.sample(truth);
      const Vector3d f = reading.f_B_mps2 - Vector3d(0, 0, kGravityMps2);
      gyro += reading.w_B_radps.squaredNorm() / (3 * kSamples);
      accelerometer += f.squaredNorm() / (3 * kSamples);
      lagged += reading.w_B_radps.x() * last / kSamples;
      last = reading.w_B_radps.x();
    }
    const double four_sigma = 4 * std::sqrt(2.0 / (3 * kSamples));
    const double variance = 1.75e-4 * 1.75e-4 * rate_hz;
    EXPECT_NEAR(gyro / variance, 1, four_sigma);
    EXPECT_NEAR(accelerometer / (2e-3 * 2e-3 * rate_hz), 1, four_sigma);
    EXPECT_NEAR(lagged / variance, 0, 4 / std::sqrt(kSamples));
  }
}

// Mean squares per axis of the bias of many units, at once and after 9 s of samples each second.
struct BiasSquares {
  double first = 0, later = 0;
};
template <class Read>
BiasSquares bias_squares(const ImuSpec& spec, int units, Read read) {
  BiasSquares squares;
  for (int n = 0; n < units; ++n) {
    Imu imu(spec, 1, static_cast<std::uint64_t>(n));
    Snapshot truth;
    squares.first += read(imu.sample(truth)).squaredNorm() / (3 * units);
    for (int i = 0; i < 9; ++i) {
      truth.t_us += 1000000;
      const Vector3d bias = read(imu.sample(truth));
      if (i == 8) squares.later += bias.squaredNorm() / (3 * units);
    }
  }
  return squares;
}

TEST(Imu, BiasWalksAwayFromItsInitialValueAsItsDensitySays) {
  ImuSpec spec = noiseless_imu();
  spec.gyro_walk_radps2_sqrthz = 0.01;
  spec.gyro_initial_bias_radps = 0.02;
  spec.accelerometer_walk_mps3_sqrthz = 0.1;
  spec.accelerometer_initial_bias_mps2 = 0.3;
  constexpr int kUnits = 2000;
  const double four_sigma = 4 * std::sqrt(2.0 / (3 * kUnits));
  const BiasSquares gyro =
      bias_squares(spec, kUnits, [](const ImuReading& reading) { return reading.w_B_radps; });
  EXPECT_NEAR(gyro.first / (0.02 * 0.02), 1, four_sigma);
  EXPECT_NEAR(gyro.later / (0.02 * 0.02 + 9 * 0.01 * 0.01), 1, four_sigma);
  const BiasSquares accelerometer =
      bias_squares(spec, kUnits, [](const ImuReading& reading) -> Vector3d {
        return reading.f_B_mps2 - Vector3d(0, 0, kGravityMps2);
      });
  EXPECT_NEAR(accelerometer.first / (0.3 * 0.3), 1, four_sigma);
  EXPECT_NEAR(accelerometer.later / (0.3 * 0.3 + 9 * 0.1 * 0.1), 1, four_sigma);
}

TEST(Imu, TheAccelerometerVibratesAsSet) {
  ImuSpec spec = noiseless_imu();
  spec.accelerometer_vibration_mps2 = 0.5;
  Imu imu(spec, 1, 0);
  constexpr int kSamples = 10000;
  double square = 0;
  Snapshot truth;
  for (int n = 0; n < kSamples; ++n, truth.t_us += 1000) {
    const ImuReading reading = imu.sample(truth);
    EXPECT_EQ(reading.w_B_radps, Vector3d::Zero());
    square += (reading.f_B_mps2 - Vector3d(0, 0, kGravityMps2)).squaredNorm() / (3 * kSamples);
  }
  EXPECT_NEAR(square / 0.25, 1, 4 * std::sqrt(2.0 / (3 * kSamples)));
}

TEST(Imu, VibrationDominatesInFlight) {
  Imu imu(ImuSpec(), 1, 0);
  constexpr int kSamples = 5000;
  Vector3d mean = Vector3d::Zero();
  double square = 0;
  Snapshot truth;
  for (int n = 0; n < kSamples; ++n, truth.t_us += 1000) {
    const Vector3d w = imu.sample(truth).w_B_radps;
    mean += w / kSamples;
    square += w.squaredNorm() / (3 * kSamples);
  }
  EXPECT_NEAR(std::sqrt(square), 0.0305, 0.001);
  EXPECT_LT(mean.norm(), 0.006);  // the initial bias
}

TEST(Imu, SaturatesAtItsRange) {
  ImuSpec spec = noiseless_imu();
  Imu imu(spec, 1, 0);
  Snapshot truth;
  truth.vehicle.w_W = Vector3d(100, -100, 1);
  truth.vehicle_a_W = Vector3d(0, -1000, 1000);
  const ImuReading reading = imu.sample(truth);
  EXPECT_EQ(reading.w_B_radps, Vector3d(spec.gyro_range_radps, -spec.gyro_range_radps, 1));
  EXPECT_EQ(reading.f_B_mps2,
            Vector3d(0, -spec.accelerometer_range_mps2, spec.accelerometer_range_mps2));
}

TEST(Imu, NeitherDoesItsNoiseReadBeyondTheRange) {
  ImuSpec spec = noiseless_imu();
  spec.gyro_vibration_radps = 0.5;
  spec.accelerometer_vibration_mps2 = 0.5;
  Imu imu(spec, 1, 0);
  Snapshot truth;
  truth.vehicle.w_W = Vector3d(spec.gyro_range_radps, 0, 0);
  truth.vehicle_a_W = Vector3d(spec.accelerometer_range_mps2, 0, 0);
  int full = 0;
  for (int n = 0; n < 1000; ++n, truth.t_us += 1000) {
    const ImuReading reading = imu.sample(truth);
    EXPECT_LE(reading.w_B_radps.x(), spec.gyro_range_radps);
    EXPECT_LE(reading.f_B_mps2.x(), spec.accelerometer_range_mps2);
    full += reading.w_B_radps.x() == spec.gyro_range_radps;
  }
  EXPECT_NEAR(full, 500, 4 * std::sqrt(250.0));  // the noise goes either way
}

TEST(Imu, ReadingsRepeatForTheSameThrowAndDifferBetweenThrowsAndUnits) {
  const Snapshot truth;
  const Vector3d w = Imu(ImuSpec(), 3, 5).sample(truth).w_B_radps;
  EXPECT_EQ(Imu(ImuSpec(), 3, 5).sample(truth).w_B_radps, w);
  EXPECT_NE(Imu(ImuSpec(), 3, 6).sample(truth).w_B_radps, w);
  EXPECT_NE(Imu(ImuSpec(), 4, 5).sample(truth).w_B_radps, w);
  EXPECT_NE(Imu(ImuSpec(), 3, 5, "flight_controller").sample(truth).w_B_radps, w);
}

// Streams are separate: a change of one kind of noise leaves the others as they were.
TEST(Imu, TurningOffOneNoiseLeavesTheOthers) {
  ImuSpec with = noiseless_imu();
  with.gyro_density_radps_sqrthz = 1e-3;
  with.gyro_vibration_radps = 0.1;
  ImuSpec white_only = with;
  white_only.gyro_vibration_radps = 0;
  ImuSpec vibration_only = with;
  vibration_only.gyro_density_radps_sqrthz = 0;
  const Snapshot truth;
  const Vector3d sum = Imu(white_only, 1, 0).sample(truth).w_B_radps +
                       Imu(vibration_only, 1, 0).sample(truth).w_B_radps;
  EXPECT_TRUE(Imu(with, 1, 0).sample(truth).w_B_radps.isApprox(sum, 1e-12));
}

TEST(Imu, GyroscopeAloneReadsTheSame) {
  Imu whole(ImuSpec(), 3, 5), gyro(ImuSpec(), 3, 5);
  Snapshot truth;
  truth.vehicle.q_W = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized());
  for (truth.t_us = 0; truth.t_us < 100000; truth.t_us += 250) {
    truth.vehicle.w_W = Vector3d(0.3, -0.2, 1e-6 * static_cast<double>(truth.t_us));
    EXPECT_EQ(gyro.sample_gyro(truth), whole.sample(truth).w_B_radps);
  }
}

TEST(Imu, IsDueAtItsRate) {
  const Imu imu(ImuSpec(), 1, 0);
  EXPECT_TRUE(imu.due(0));
  EXPECT_FALSE(imu.due(250));
  EXPECT_TRUE(imu.due(3000));
  ImuSpec odd;
  odd.rate_hz = 300;
  EXPECT_THROW(Imu(odd, 1, 0), ScenarioError);
}

}  // namespace
}  // namespace dodgesim
