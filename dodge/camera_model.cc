#include "dodge/camera_model.h"

#include <cmath>

namespace dodge {

namespace {

// Newton's method for the inverse of the radtan model.
constexpr int kMostSteps = 50;
constexpr double kExact = 1e-9;

Eigen::Vector2d distort(const CameraModel& camera, const Eigen::Vector2d& p) {
  const double r2 = p.squaredNorm();
  const double radial = 1 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3));
  const double xy = p.x() * p.y();
  return {p.x() * radial + 2 * camera.p1 * xy + camera.p2 * (r2 + 2 * p.x() * p.x()),
          p.y() * radial + camera.p1 * (r2 + 2 * p.y() * p.y()) + 2 * camera.p2 * xy};
}

// Derivative of distort() by p.
Eigen::Matrix2d stretch(const CameraModel& camera, const Eigen::Vector2d& p) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3));
  const double slope = 2 * (camera.k1 + r2 * (2 * camera.k2 + 3 * r2 * camera.k3));
  const double mixed = x * y * slope + 2 * (camera.p1 * x + camera.p2 * y);
  Eigen::Matrix2d J;
  J << radial + x * x * slope + 2 * camera.p1 * y + 6 * camera.p2 * x, mixed, mixed,
      radial + y * y * slope + 6 * camera.p1 * y + 2 * camera.p2 * x;
  return J;
}

// Whether distort() does not fold: on the way from the axis to p it stretches, and never turns
// back.
bool unfolded(const CameraModel& camera, const Eigen::Vector2d& p) {
  constexpr int kPieces = 16;
  for (int i = 1; i <= kPieces; ++i) {
    if (stretch(camera, p * i / kPieces).determinant() <= 0) return false;
  }
  return true;
}

// The inverse of distort(); NaN where it has none.
Eigen::Vector2d undistorted(const CameraModel& camera, const Eigen::Vector2d& distorted) {
  if (camera.k1 == 0 && camera.k2 == 0 && camera.p1 == 0 && camera.p2 == 0 && camera.k3 == 0) {
    return distorted;
  }
  Eigen::Vector2d ideal = distorted;
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Vector2d error = distorted - distort(camera, ideal);
    if (error.norm() <= kExact) break;
    ideal += stretch(camera, ideal).inverse() * error;
  }
  const bool found = (distorted - distort(camera, ideal)).norm() <= kExact;
  if (!found || !unfolded(camera, ideal)) ideal.setConstant(std::nan(""));
  return ideal;
}

}  // namespace

Eigen::Vector2d CameraModel::bearing(const Eigen::Vector2d& pixel) const {
  if (!lens) return undistorted(*this, {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy});
  const Eigen::Vector2d bearing_L =
      undistorted(*this, {(pixel.x() - lens->cx) / lens->fx, (pixel.y() - lens->cy) / lens->fy});
  const Eigen::Vector3d ray_C = lens->R_CL * bearing_L.homogeneous();
  if (!(ray_C.z() > 0)) return Eigen::Vector2d::Constant(std::nan(""));
  return ray_C.hnormalized();
}

Eigen::Vector2d CameraModel::project(const Eigen::Vector3d& p_C) const {
  return {fx * p_C.x() / p_C.z() + cx, fy * p_C.y() / p_C.z() + cy};
}

std::vector<Eigen::Vector2f> CameraModel::bearing_table() const {
  std::vector<Eigen::Vector2f> table;
  table.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) table.push_back(bearing({x, y}).cast<float>());
  }
  return table;
}

}  // namespace dodge
