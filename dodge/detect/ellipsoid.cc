#include "dodge/detect/ellipsoid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace dodge {
namespace {

constexpr int kDimension = 3;
constexpr int kRegularisingPoints = 2 * kDimension;
// Khachiyan's gap: the volume is at most (1 + gap)^(3/2) of the smallest.
constexpr double kFitGap = 1e-3;
constexpr int kMaxFitIterations = 2000;
constexpr int kMaxRootIterations = 100;
// Coordinates this small against their semi-axis count as lying on the plane of symmetry.
constexpr double kOnPlane = 1e-12;
// Keeps an ellipsoid without extent from dividing by zero.
constexpr double kMinSemiAxisM = 1e-6;

struct FitPoints {
  std::array<Eigen::Vector3d, kMaxFitPoints + kRegularisingPoints> p;
  int count = 0;
  void add(const Eigen::Vector3d& point) { p[static_cast<std::size_t>(count++)] = point; }
};

using Weights = std::array<double, kMaxFitPoints + kRegularisingPoints>;

// Second moments of the lifted points (p, 1) under the weights: mean and covariance in one matrix.
Eigen::Matrix4d lifted_moments(const FitPoints& points, const Weights& u) {
  Eigen::Matrix4d X = Eigen::Matrix4d::Zero();
  for (int i = 0; i < points.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Vector4d q = points.p[k].homogeneous();
    X.noalias() += u[k] * q * q.transpose();
  }
  return X;
}

// Moves weight towards the farthest point, or away from the nearest one that still has weight,
// whichever violates the optimality conditions more. Returns false at the optimum.
bool improve_weights(const FitPoints& points, Weights& u) {
  constexpr double n = kDimension + 1;
  const Eigen::Matrix4d X_inverse = lifted_moments(points, u).inverse();
  std::size_t farthest = 0, nearest = 0;
  double m_max = -1, m_min = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < static_cast<std::size_t>(points.count); ++i) {
    const Eigen::Vector4d q = points.p[i].homogeneous();
    const double m = q.dot(X_inverse * q);
    if (m > m_max) {
      m_max = m;
      farthest = i;
    }
    if (u[i] > 0 && m < m_min) {
      m_min = m;
      nearest = i;
    }
  }
  if (m_max / n - 1 < kFitGap && 1 - m_min / n < kFitGap) return false;
  if (m_max - n >= n - m_min) {
    const double step = (m_max - n) / (n * (m_max - 1));
    for (double& weight : u) weight *= 1 - step;
    u[farthest] += step;
    return true;
  }
  const double all_of_it = u[nearest] / (1 - u[nearest]);
  const double step = m_min > 1 ? std::min((n - m_min) / (n * (m_min - 1)), all_of_it) : all_of_it;
  for (double& weight : u) weight *= 1 + step;
  u[nearest] = step == all_of_it ? 0 : u[nearest] - step;
  return true;
}

// The functions below take the first n coordinates of an axis-aligned ellipsoid's semi-axes e,
// descending, and of a point y in the first orthant. The others of the closest point are 0.

// The closest point for a y off the plane of the shortest axis, as the root of a function. That is
// convex and falling, so that Newton from the left end, in place of Eberly's bisection, never
// oversteps.
Eigen::Vector3d by_root(const Eigen::Vector3d& e, const Eigen::Vector3d& y, int n) {
  const int last = n - 1;
  Eigen::Array3d r, z;
  for (int i = 0; i < n; ++i) {
    r[i] = (e[i] / e[last]) * (e[i] / e[last]);
    z[i] = y[i] / e[i];
  }
  double s = z[last] - 1;  // here the last term alone is 1, so the root is not to the left
  for (int k = 0; k < kMaxRootIterations; ++k) {
    double g = -1, slope = 0;
    for (int i = 0; i < n; ++i) {
      const double ratio = r[i] * z[i] / (s + r[i]);
      g += ratio * ratio;
      slope -= 2 * ratio * ratio / (s + r[i]);
    }
    const double next = s - g / slope;
    if (!(next > s)) break;
    s = next;
  }
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int i = 0; i < n; ++i) x[i] = r[i] * y[i] / (s + r[i]);
  return x;
}

// For a y on that plane: the closest point if it lies off the plane, as it does near the centre.
std::optional<Eigen::Vector3d> off_plane(const Eigen::Vector3d& e, const Eigen::Vector3d& y,
                                         int n) {
  const int last = n - 1;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  double rest = 1;
  for (int i = 0; i < last; ++i) {
    const double numerator = e[i] * y[i];
    const double denominator = e[i] * e[i] - e[last] * e[last];
    if (!(numerator < denominator)) return std::nullopt;
    const double ratio = numerator / denominator;
    x[i] = e[i] * ratio;
    rest -= ratio * ratio;
  }
  if (!(rest > 0)) return std::nullopt;
  x[last] = e[last] * std::sqrt(rest);
  return x;
}

// Eberly's case distinction. It ends at n = 1, where off_plane() always has a point.
Eigen::Vector3d closest_in_first_orthant(const Eigen::Vector3d& e, const Eigen::Vector3d& y,
                                         int n) {
  const bool on_plane = y[n - 1] <= kOnPlane * e[n - 1];
  if (!on_plane) return by_root(e, y, n);
  const std::optional<Eigen::Vector3d> x = off_plane(e, y, n);
  return x ? *x : closest_in_first_orthant(e, y, n - 1);
}

}  // namespace

Ellipsoid sphere(const Eigen::Vector3d& centre_W, double radius_m) {
  return {centre_W, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Constant(radius_m)};
}

Ellipsoid minimum_volume_ellipsoid(std::span<const Eigen::Vector3d> points_W,
                                   double min_half_width_m) {
  points_W = points_W.first(std::min<std::size_t>(points_W.size(), kMaxFitPoints));
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points_W) mean += p / static_cast<double>(points_W.size());

  // Relative to the mean and in units of the extent, for the conditioning.
  double unit = std::max(min_half_width_m, kMinSemiAxisM);
  for (const Eigen::Vector3d& p : points_W) unit = std::max(unit, (p - mean).norm());
  FitPoints points;
  for (const Eigen::Vector3d& p : points_W) points.add((p - mean) / unit);
  const double half_width = std::max(min_half_width_m, kMinSemiAxisM) / unit;
  for (int axis = 0; axis < kDimension; ++axis) {
    points.add(half_width * Eigen::Vector3d::Unit(axis));
    points.add(-half_width * Eigen::Vector3d::Unit(axis));
  }

  Weights u{};
  std::fill_n(u.begin(), points.count, 1.0 / points.count);
  for (int k = 0; k < kMaxFitIterations && improve_weights(points, u); ++k) {
  }

  const Eigen::Matrix4d X = lifted_moments(points, u);
  const Eigen::Vector3d c = X.topRightCorner<3, 1>() / X(3, 3);
  const Eigen::Matrix3d shape =
      kDimension * (X.topLeftCorner<3, 3>() / X(3, 3) - c * c.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(shape);
  Ellipsoid fit;
  fit.axes_W = eigen.eigenvectors();
  const Eigen::Vector3d axes = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  // What is left of the gap is made up by scaling, so that no point is outside.
  double farthest = 0;
  for (int i = 0; i < points.count; ++i) {
    const Eigen::Vector3d local =
        fit.axes_W.transpose() * (points.p[static_cast<std::size_t>(i)] - c);
    farthest = std::max(farthest, local.cwiseQuotient(axes).squaredNorm());
  }
  fit.semi_axes_m = unit * std::sqrt(farthest) * axes;
  fit.centre_W = mean + unit * c;
  return fit;
}

SurfaceDistance distance_to_surface(const Ellipsoid& ellipsoid, const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d local = ellipsoid.axes_W.transpose() * (p_W - ellipsoid.centre_W);
  const Eigen::Vector3d semi_axes = ellipsoid.semi_axes_m.cwiseMax(kMinSemiAxisM);
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return semi_axes[a] > semi_axes[b] || (semi_axes[a] == semi_axes[b] && a < b);
  });
  Eigen::Vector3d e, y;
  for (int i = 0; i < 3; ++i) {
    const int axis = order[static_cast<std::size_t>(i)];
    e[i] = semi_axes[axis];
    y[i] = std::abs(local[axis]);
  }
  const Eigen::Vector3d x = closest_in_first_orthant(e, y, kDimension);

  // The normal from the surface equation is defined also where the point lies on the surface.
  Eigen::Vector3d normal;
  for (int i = 0; i < 3; ++i) {
    const int axis = order[static_cast<std::size_t>(i)];
    normal[axis] = std::copysign(x[i] / (e[i] * e[i]), local[axis]);
  }
  const double inside = y.cwiseQuotient(e).squaredNorm() < 1 ? -1.0 : 1.0;
  return {inside * (y - x).norm(), ellipsoid.axes_W * normal.normalized()};
}

}  // namespace dodge
