#include "sim/render/primitive_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/camera/sphere_bounds.h"

namespace dodgesim {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMarginPx = 1;  // for the rounding of what the outline only just touches

// About the corners of a box, if all are in front of the camera; the whole plane otherwise.
ImageBox box_bounds(const Vector3d& half, const Eigen::Isometry3d& X_CB,
                    const Intrinsics& intrinsics, double near_m) {
  ImageBox bounds;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Vector3d p_C = X_CB * sign.cwiseProduct(half);
    if (p_C.z() < near_m) {
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      return {Eigen::Vector2d::Constant(-kInfinity), Eigen::Vector2d::Constant(kInfinity)};
    }
    bounds.extend(intrinsics.project(p_C));
  }
  return bounds;
}

// Quadratic form in the ray d that is positive where the ray hits: an ellipsoid, d.d - |eye x d|^2
// in coordinates in which it is the unit sphere; a cylinder, the same across its axis.
Matrix3d outline_form(const Primitive& primitive, const Vector3d& eye) {
  if (primitive.type == mjGEOM_ELLIPSOID) {
    const Vector3d scale = primitive.size.cwiseInverse();
    const Vector3d e = scale.cwiseProduct(eye);
    Matrix3d cross;
    cross << 0, -e.z(), e.y(), e.z(), 0, -e.x(), -e.y(), e.x(), 0;
    const Matrix3d form = Matrix3d::Identity() - cross.transpose() * cross;
    return scale.asDiagonal() * form * scale.asDiagonal();
  }
  const double radius = primitive.size.x();
  const Vector3d moment(-eye.y(), eye.x(), 0);
  return Vector3d(radius * radius, radius * radius, 0).asDiagonal().toDenseMatrix() -
         moment * moment.transpose();
}

// Where the outline is bent most, its radius of curvature [px]; 0 if it is no ellipse.
double sharpest_bend_px(const Matrix3d& conic) {
  const Eigen::Matrix2d form = -conic.topLeftCorner<2, 2>();
  const double determinant = form.determinant();
  if (!(determinant > 0 && form.trace() > 0)) return 0;
  // At the centre the quadratic form is conic.determinant() / determinant, and with eigenvalues
  // flat < steep of `form` the semi-axes squared are that over these.
  const double at_center = conic.determinant() / determinant;
  const double half_trace = 0.5 * form.trace();
  const double steep = half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - determinant));
  const double flat = determinant / steep;
  return at_center > 0 ? std::sqrt(at_center * flat) / steep : 0;
}

// Over a length w the tangent of a circle of radius R misses an area of w^3 / (24 R).
int pieces_along_pixel(double radius_px) {
  constexpr int kMost = 4;
  constexpr double kArea = 0.003;  // [px^2]
  const double pieces = std::ceil(std::sqrt(1 / (24 * kArea * std::max(radius_px, 0.1))));
  return std::min(kMost, static_cast<int>(pieces));
}

bool camera_inside(const Primitive& primitive, const Vector3d& eye) {
  const Vector3d& size = primitive.size;
  switch (primitive.type) {
    case mjGEOM_ELLIPSOID:
      return eye.cwiseQuotient(size).norm() <= 1.0;
    case mjGEOM_CYLINDER:
      return std::hypot(eye.x(), eye.y()) <= size.x() && std::abs(eye.z()) <= size.z();
    case mjGEOM_CAPSULE:
      return (eye - Vector3d(0, 0, std::clamp(eye.z(), -size.z(), size.z()))).norm() <= size.x();
    default:
      return (eye.cwiseAbs() - size).maxCoeff() <= 0.0;
  }
}

}  // namespace

PrimitiveView view_primitive(const Primitive& primitive, const Eigen::Isometry3d& X_WG,
                             const Eigen::Isometry3d& X_WC, const Intrinsics& intrinsics,
                             double near_m) {
  PrimitiveView view;
  const Eigen::Isometry3d X_GC = X_WG.inverse() * X_WC;
  const Vector3d center_C = X_WC.inverse() * X_WG.translation();
  const double radius = primitive.bounding_radius();
  view.in_front = center_C.z() > radius;
  view.distance = center_C.norm();
  view.R_GC = X_GC.linear();
  view.eye_G = X_GC.translation();
  view.visible = center_C.z() + radius > near_m && !camera_inside(primitive, view.eye_G);
  if (!view.visible) return view;

  const bool capsule = primitive.type == mjGEOM_CAPSULE;
  const Vector3d half = primitive.size + Vector3d(0, 0, capsule ? primitive.size.x() : 0.0);
  // The sphere about a long solid is larger than the box about it.
  const ImageBox bounds = sphere_bounds(intrinsics, center_C, radius)
                              .intersection(box_bounds(half, X_GC.inverse(), intrinsics, near_m));
  view.bounds = pixels_about(bounds, kMarginPx, intrinsics);
  // Half a pixel's diagonal, at the far side of the solid.
  view.margin = 0.75 * (center_C.z() + radius) / intrinsics.f;
  if (primitive.type == mjGEOM_BOX) return view;

  view.conic_origin = {intrinsics.cx(), intrinsics.cy()};
  if (view.in_front) view.conic_origin = intrinsics.project(center_C);
  Matrix3d ray_of_pixel = Matrix3d::Identity();
  ray_of_pixel.diagonal().head<2>().setConstant(1.0 / intrinsics.f);
  ray_of_pixel(0, 2) = (view.conic_origin.x() - intrinsics.cx()) / intrinsics.f;
  ray_of_pixel(1, 2) = (view.conic_origin.y() - intrinsics.cy()) / intrinsics.f;
  const Matrix3d ray_G = view.R_GC * ray_of_pixel;
  view.conic = ray_G.transpose() * outline_form(primitive, view.eye_G) * ray_G;
  view.conic /= view.conic.cwiseAbs().maxCoeff();
  view.outline_pieces = pieces_along_pixel(sharpest_bend_px(view.conic));
  return view;
}

}  // namespace dodgesim
