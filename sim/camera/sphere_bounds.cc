#include "sim/camera/sphere_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dodgesim {

namespace {

struct Range {
  double low, high;
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kNothing = {kInfinity, -kInfinity};

// The tangents of the angles to the optical axis under which a circle about (lateral, depth) is
// seen in the plane of an image axis and the optical axis. A sphere's shadow in this plane is this
// circle, so that the bounds of the sphere's image along the axis are exact.
Range tangents(double lateral, double depth, double radius) {
  const double distance = std::hypot(lateral, depth);
  if (distance <= radius) return {-kInfinity, kInfinity};
  const double middle = std::atan2(lateral, depth);
  const double half = std::asin(radius / distance);
  constexpr double kSide = 0.5 * std::numbers::pi;
  if (middle - half >= kSide || middle + half <= -kSide) return kNothing;
  return {middle - half <= -kSide ? -kInfinity : std::tan(middle - half),
          middle + half >= kSide ? kInfinity : std::tan(middle + half)};
}

// The first or last pixel, clipped; the box may be unbounded.
int clipped(double pixel, int size) {
  return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(size)));
}

}  // namespace

ImageBox sphere_bounds(const Intrinsics& intrinsics, const Eigen::Vector3d& centre_C,
                       double radius_m) {
  const Range x = tangents(centre_C.x(), centre_C.z(), radius_m);
  const Range y = tangents(centre_C.y(), centre_C.z(), radius_m);
  if (centre_C.z() <= -radius_m || x.low > x.high || y.low > y.high) return ImageBox();
  const Eigen::Vector2d principal(intrinsics.cx(), intrinsics.cy());
  return {intrinsics.f * Eigen::Vector2d(x.low, y.low) + principal,
          intrinsics.f * Eigen::Vector2d(x.high, y.high) + principal};
}

Rect pixels_about(const ImageBox& box, double margin_px, const Intrinsics& intrinsics) {
  if (box.isEmpty()) return {};
  // A pixel reaches half a pixel to each side of its centre.
  const double reach = margin_px + 0.5;
  return {clipped(std::ceil(box.min().x() - reach), intrinsics.width),
          clipped(std::ceil(box.min().y() - reach), intrinsics.height),
          clipped(std::floor(box.max().x() + reach) + 1, intrinsics.width),
          clipped(std::floor(box.max().y() + reach) + 1, intrinsics.height)};
}

}  // namespace dodgesim
