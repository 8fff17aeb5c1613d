#include "sim/config/stereo_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "sim/base/error.h"
#include "sim/base/formatted.h"

namespace dodgesim {

namespace {

using Eigen::Vector3d;

constexpr double kRoundingOfText = 1e-6;  // [rad], relative to the baseline and to focal lengths
constexpr double kMostAside = std::numbers::pi / 6;

double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

bool are_rectified(const dodge::CameraModel& upper, const dodge::CameraModel& lower) {
  const Vector3d down = upper.X_BC.inverse() * lower.X_BC.translation();
  const Eigen::Vector4d a(upper.fx, upper.fy, upper.cx, upper.cy);
  const Eigen::Vector4d b(lower.fx, lower.fy, lower.cx, lower.cy);
  return down.norm() > 0 && (a - b).norm() <= kRoundingOfText * upper.fx &&
         Eigen::AngleAxisd(upper.X_BC.linear().transpose() * lower.X_BC.linear()).angle() <=
             kRoundingOfText &&
         angle_between(down, Vector3d::UnitY()) <= kRoundingOfText;
}

// Chains put each camera into a B of its own; what they share is the frame of the IMU.
void move_to_body_of(const CameraCalibration& upper, CameraCalibration& lower) {
  const Eigen::Isometry3d X_UpperLower(upper.R_BG * lower.R_BG.transpose());
  lower.camera.X_BC = X_UpperLower * lower.camera.X_BC;
  lower.R_BG = upper.R_BG;
}

// The orientation that both are to have.
Eigen::Matrix3d common_axes(const dodge::CameraModel& upper, const dodge::CameraModel& lower) {
  const Eigen::Matrix3d &U = upper.X_BC.linear(), &L = lower.X_BC.linear();
  const Vector3d baseline_B = lower.X_BC.translation() - upper.X_BC.translation();
  const double aside =
      std::max(angle_between(baseline_B, U.col(1)), angle_between(baseline_B, L.col(1)));
  const std::string need =
      "Stereo needs the second camera below the first, along the columns of both images, but their "
      "calibrations ";
  if (!(baseline_B.norm() > 0)) {
    throw ScenarioError(need +
                        "give both the same place (p_BC_m; of a chain T_cam_imu or T_cn_cnm1).");
  }
  const bool above = std::max(angle_between(-baseline_B, U.col(1)),
                              angle_between(-baseline_B, L.col(1))) <= kMostAside;
  if (above) throw ScenarioError(need + "put it above the first: give the upper camera first.");
  if (aside > kMostAside) {
    throw ScenarioError(need +
                        formatted("put it %.0f degrees aside.", aside * 180 / std::numbers::pi));
  }
  Eigen::Matrix3d R_BC;
  R_BC.col(1) = baseline_B.normalized();
  R_BC.col(0) = R_BC.col(1).cross(U.col(2) + L.col(2)).normalized();
  R_BC.col(2) = R_BC.col(0).cross(R_BC.col(1));
  return R_BC;
}

}  // namespace

StereoPair rectified(const CameraCalibration& upper, const CameraCalibration& lower) {
  StereoPair pair = {upper, lower};
  dodge::CameraModel &u = pair.upper.camera, &l = pair.lower.camera;
  if (!upper.name.empty() && !lower.name.empty()) move_to_body_of(upper, pair.lower);
  if (u.width != l.width || u.height != l.height || are_rectified(u, l)) return pair;
  const Eigen::Matrix3d R_BC = common_axes(u, l);
  const double f = 0.25 * (u.fx + u.fy + l.fx + l.fy);
  const Eigen::Vector2d c = 0.5 * Eigen::Vector2d(u.cx + l.cx, u.cy + l.cy);
  for (dodge::CameraModel* camera : {&u, &l}) {
    camera->lens = {camera->fx, camera->fy, camera->cx, camera->cy,
                    R_BC.transpose() * camera->X_BC.linear()};
    camera->fx = camera->fy = f;
    camera->cx = c.x();
    camera->cy = c.y();
    camera->X_BC.linear() = R_BC;
  }
  return pair;
}

}  // namespace dodgesim
