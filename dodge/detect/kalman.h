// Constant-velocity Kalman filter of one obstacle: Falanga et al. 2020, equations (13) to (25).
#pragma once

#include <Eigen/Dense>

#include "dodge/types.h"

namespace dodge {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct KalmanConfig {
  double acceleration_noise_mps2_sqrthz = 3.0;
  double initial_speed_sigma_mps = 6.0;
  double lateral_sigma_m = 0.02;
  double lateral_size_share = 0.0;
  double min_depth_sigma_m = 0.02;
  bool gravity = false;

  template <class Visitor>
  void visit(Visitor& v) {
    v("acceleration_noise_mps2_sqrthz", acceleration_noise_mps2_sqrthz, 0.0, 1000.0,
      "Square root of the spectral density of the obstacle's acceleration [m/s^2/sqrt(Hz)], from "
      "which Q of (22) follows exactly. A thrown object falls and the filter does not know it: 3 "
      "covers g over about 0.1 s.");
    v("initial_speed_sigma_mps", initial_speed_sigma_mps, 1e-3, 1000.0,
      "Standard deviation per axis of a new obstacle's velocity around zero; 10 m/s is the fastest "
      "throw of the paper.");
    v("lateral_sigma_m", lateral_sigma_m, 1e-4, 10.0,
      "Standard deviation of a detection across the line of sight (R of (23)): about 2 px at 2 m.");
    v("lateral_size_share", lateral_size_share, 0.0, 1.0,
      "Adds this share of the detected size to that standard deviation, in squares: the more of "
      "the background a cluster holds, the less it tells where the object is. 0: the same for "
      "all, as in the paper.");
    v("min_depth_sigma_m", min_depth_sigma_m, 1e-4, 10.0,
      "Least standard deviation of a detection along the line of sight, whatever the depth stage "
      "claims.");
    v("gravity", gravity,
      "Whether the prediction includes free fall. An extension: the paper's model is constant "
      "velocity, thrown objects fall.");
  }
};

// R of (23) for a detection [m^2], in W: depth_sigma_m along the line of sight (through the near
// and the far centre), lateral_sigma_m and lateral_size_share of its size across it.
Eigen::Matrix3d measurement_covariance(const KalmanConfig& config, const Detection& detection);

// Position and velocity in W, [m] and [m/s].
class Kalman {
 public:
  // z_W: the position measured at t_us [m]; R: its covariance [m^2].
  Kalman(const KalmanConfig& config, TimeUs t_us, const Eigen::Vector3d& z_W,
         const Eigen::Matrix3d& R);

  // (21), (22) up to t_us; an instant in the past leaves the state as it is.
  void predict(TimeUs t_us);

  // (21) to (25) with the position measured at t_us. One from before the state's instant is
  // compared with where the state says the obstacle was then, as if no noise had acted since.
  void update(TimeUs t_us, const Eigen::Vector3d& z_W, const Eigen::Matrix3d& R);

  struct Position {
    Eigen::Vector3d mean_W;        // [m]
    Eigen::Matrix3d covariance_W;  // [m^2]
  };
  // Where the obstacle will be at t_us, or was then as if no noise had acted since.
  Position position_at(TimeUs t_us) const;

  TimeUs t_us() const { return t_us_; }
  Eigen::Vector3d position() const { return x_.head<3>(); }
  Eigen::Vector3d velocity() const { return x_.tail<3>(); }
  const Matrix6d& covariance() const { return P_; }  // of (position, velocity) [m, m/s]

 private:
  Eigen::Vector3d past_position(double age_s) const;

  KalmanConfig config_;
  TimeUs t_us_;
  Vector6d x_;
  Matrix6d P_;
};

}  // namespace dodge
