#include "dodge/detect/kalman.h"

#include <algorithm>
#include <cmath>

namespace dodge {
namespace {

// The near and far centre are this far apart at least to give a line of sight.
constexpr double kNoDirectionM = 1e-9;

using Matrix36d = Eigen::Matrix<double, 3, 6>;

// H: the position age_s before the state's instant, but for gravity's share.
Matrix36d past_position_of_state(double age_s) {
  Matrix36d H;
  H << Eigen::Matrix3d::Identity(), -age_s * Eigen::Matrix3d::Identity();
  return H;
}

}  // namespace

Eigen::Matrix3d measurement_covariance(const KalmanConfig& config, const Detection& detection) {
  const double lateral =
      std::hypot(config.lateral_sigma_m, config.lateral_size_share * detection.size_m);
  const double along =
      std::max(detection.depth_sigma_m * detection.distance_per_depth, config.min_depth_sigma_m);
  const Eigen::Vector3d ray = detection.p_W[5] - detection.p_W[4];
  const double length = ray.norm();
  if (length < kNoDirectionM) {
    const double largest = std::max(lateral, along);
    return largest * largest * Eigen::Matrix3d::Identity();
  }
  const Eigen::Vector3d sight = ray / length;
  return lateral * lateral * Eigen::Matrix3d::Identity() +
         (along * along - lateral * lateral) * sight * sight.transpose();
}

Kalman::Kalman(const KalmanConfig& config, TimeUs t_us, const Eigen::Vector3d& z_W,
               const Eigen::Matrix3d& R)
    : config_(config), t_us_(t_us) {
  x_ << z_W, Eigen::Vector3d::Zero();
  const double sigma = config.initial_speed_sigma_mps;
  P_.setZero();
  P_.topLeftCorner<3, 3>() = R;
  P_.bottomRightCorner<3, 3>() = sigma * sigma * Eigen::Matrix3d::Identity();
}

void Kalman::predict(TimeUs t_us) {
  if (t_us <= t_us_) return;
  const double dt = seconds(t_us - t_us_);  // (15)
  t_us_ = t_us;
  Matrix6d A = Matrix6d::Identity();  // (19)
  A.topRightCorner<3, 3>() = dt * Eigen::Matrix3d::Identity();
  x_ = A * x_;  // (21)
  if (config_.gravity) {
    x_[2] -= 0.5 * kGravityMps2 * dt * dt;
    x_[5] -= kGravityMps2 * dt;
  }
  // White acceleration, integrated exactly over dt.
  const double q = config_.acceleration_noise_mps2_sqrthz * config_.acceleration_noise_mps2_sqrthz;
  P_ = A * P_ * A.transpose();  // (22)
  for (int i = 0; i < 3; ++i) {
    P_(i, i) += q * dt * dt * dt / 3;
    P_(i, i + 3) += q * dt * dt / 2;
    P_(i + 3, i) += q * dt * dt / 2;
    P_(i + 3, i + 3) += q * dt;
  }
}

Eigen::Vector3d Kalman::past_position(double age_s) const {
  Eigen::Vector3d p_W = position() - age_s * velocity();
  if (config_.gravity) p_W[2] -= 0.5 * kGravityMps2 * age_s * age_s;
  return p_W;
}

Kalman::Position Kalman::position_at(TimeUs t_us) const {
  Kalman then = *this;
  then.predict(t_us);
  const double age_s = seconds(then.t_us_ - t_us);
  const Matrix36d H = past_position_of_state(age_s);
  return {then.past_position(age_s), H * then.P_ * H.transpose()};
}

// As in the paper, detections count as independent. Successive windows overlap and share events:
// they are not, and the covariance is smaller than the error it stands for.
void Kalman::update(TimeUs t_us, const Eigen::Vector3d& z_W, const Eigen::Matrix3d& R) {
  predict(t_us);
  const double age_s = seconds(t_us_ - t_us);
  const Matrix36d H = past_position_of_state(age_s);
  const Matrix36d HP = H * P_;
  const Eigen::Matrix3d S = HP * H.transpose() + R;
  const Eigen::Matrix<double, 6, 3> K = S.llt().solve(HP).transpose();  // (23)
  x_ += K * (z_W - past_position(age_s));                               // (24)
  const Matrix6d I_KH = Matrix6d::Identity() - K * H;
  const Matrix6d P = I_KH * P_ * I_KH.transpose() + K * R * K.transpose();  // (25)
  P_ = 0.5 * (P + P.transpose());
}

}  // namespace dodge
