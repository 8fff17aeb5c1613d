#include "dodge/detect/ellipsoid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "tests/dodge/generator.h"
#include "tests/dodge/solve.h"

namespace dodge {
namespace {

using Eigen::Vector3d;
using SixPoints = std::array<Vector3d, 6>;

double log_volume(const Ellipsoid& ellipsoid) { return ellipsoid.semi_axes_m.array().log().sum(); }

// 1 on the surface, less inside.
double level(const Ellipsoid& ellipsoid, const Vector3d& p) {
  const Vector3d local = ellipsoid.axes_W.transpose() * (p - ellipsoid.centre_W);
  return local.cwiseQuotient(ellipsoid.semi_axes_m).norm();
}

// Independent optimum of log(volume / unit ball): the primal problem {|B p + b| <= 1}, B lower
// triangular, minimise -log det B, by Newton steps on a log barrier. The gap to the true optimum is
// at most 2 * 6 / kSharpness.
double optimal_log_volume(const SixPoints& points) {
  constexpr double kSharpness = 0x1p20;
  using Vector9d = Eigen::Matrix<double, 9, 1>;  // B00 B10 B11 B20 B21 B22 b0 b1 b2
  using Row = Eigen::Matrix<double, 3, 9>;
  constexpr std::array<int, 3> kDiagonal = {0, 2, 5};
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : points) mean += p / 6;
  double extent = 0;
  for (const Vector3d& p : points) extent = std::max(extent, (p - mean).norm());
  std::array<Row, 6> J;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vector3d q = (points[i] - mean) / extent;
    J[i].setZero();
    J[i](0, 0) = q[0];
    J[i](1, 1) = q[0], J[i](1, 2) = q[1];
    J[i](2, 3) = q[0], J[i](2, 4) = q[1], J[i](2, 5) = q[2];
    J[i].rightCols<3>().setIdentity();
  }
  const auto cost = [&](const Vector9d& x, double t) {
    double sum = 0;
    for (const int d : kDiagonal) {
      if (x[d] <= 0) return std::numeric_limits<double>::infinity();
      sum -= t * std::log(x[d]);
    }
    for (const Row& row : J) {
      const double slack = 1 - (row * x).squaredNorm();
      if (slack <= 0) return std::numeric_limits<double>::infinity();
      sum -= std::log(slack);
    }
    return sum;
  };
  Vector9d x = Vector9d::Zero();
  for (const int d : kDiagonal) x[d] = 0.5;
  for (double t = 1; t <= kSharpness; t *= 4) {
    for (int k = 0; k < 50; ++k) {
      Vector9d gradient = Vector9d::Zero();
      Eigen::Matrix<double, 9, 9> hessian = Eigen::Matrix<double, 9, 9>::Zero();
      for (const int d : kDiagonal) {
        gradient[d] -= t / x[d];
        hessian(d, d) += t / (x[d] * x[d]);
      }
      for (const Row& row : J) {
        const Vector3d r = row * x;
        const double slack = 1 - r.squaredNorm();
        const Vector9d Jr = row.transpose() * r;
        gradient += 2 / slack * Jr;
        hessian += 2 / slack * row.transpose() * row + 4 / (slack * slack) * Jr * Jr.transpose();
      }
      const Vector9d step = -solve(hessian, gradient);
      const double decrement = -gradient.dot(step);
      if (decrement < 1e-10) break;
      double length = 1;
      while (cost(x + length * step, t) > cost(x, t) - 0.1 * length * decrement && length > 1e-12) {
        length *= 0.5;
      }
      x += length * step;
    }
  }
  return 3 * std::log(extent) - std::log(x[0] * x[2] * x[5]);
}

// The six points of (12): corners of a rectangle across the line of sight, near and far centre.
SixPoints detection_points(double width, double height, double depth, const Eigen::Matrix3d& R,
                           const Vector3d& centre) {
  SixPoints points = {Vector3d(0, width, height) / 2,   Vector3d(0, -width, height) / 2,
                      Vector3d(0, -width, -height) / 2, Vector3d(0, width, -height) / 2,
                      Vector3d(-depth, 0, 0),           Vector3d(depth, 0, 0)};
  for (Vector3d& p : points) p = centre + R * p;
  return points;
}

void expect_minimal(const SixPoints& points) {
  const Ellipsoid fit = minimum_volume_ellipsoid(points, 1e-6);
  for (const Vector3d& p : points) EXPECT_LE(level(fit, p), 1 + 1e-9);
  const double excess = log_volume(fit) - optimal_log_volume(points);
  EXPECT_LT(excess, std::log(1.005));
  EXPECT_GT(excess, -1e-4);
}

TEST(MinimumVolumeEllipsoid, ReferenceKnowsTheBallOfARegularOctahedron) {
  EXPECT_NEAR(optimal_log_volume({Vector3d(2, 0, 0), Vector3d(-2, 0, 0), Vector3d(0, 2, 0),
                                  Vector3d(0, -2, 0), Vector3d(0, 0, 2), Vector3d(0, 0, -2)}),
              3 * std::log(2), 1e-4);
}

TEST(MinimumVolumeEllipsoid, IsWithinOnePercentOfTheOptimumForRandomPoints) {
  Generator random(1);
  for (int k = 0; k < 300; ++k) {
    SixPoints points;
    const Vector3d centre = random.uniform_vector(-5, 5);
    for (Vector3d& p : points) p = centre + 0.2 * random.normal_vector();
    expect_minimal(points);
  }
}

TEST(MinimumVolumeEllipsoid, IsWithinOnePercentOfTheOptimumForDetections) {
  Generator random(2);
  for (int k = 0; k < 300; ++k) {
    const double width = random.uniform(0.03, 0.5);
    expect_minimal(detection_points(width, random.uniform(0.02, 0.5), width, random.rotation(),
                                    random.uniform_vector(-5, 5)));
  }
}

TEST(MinimumVolumeEllipsoid, OfASquareDetectionHasTheCornersAndCentresOnItsAxes) {
  const Ellipsoid fit = minimum_volume_ellipsoid(
      detection_points(0.2, 0.2, 0.2, Eigen::Matrix3d::Identity(), Vector3d(1, 2, 3)), 0.01);
  EXPECT_TRUE(fit.centre_W.isApprox(Vector3d(1, 2, 3), 1e-4));
  EXPECT_NEAR(fit.semi_axes_m[0], 0.1 * std::numbers::sqrt2, 1e-3);
  EXPECT_NEAR(fit.semi_axes_m[1], 0.1 * std::numbers::sqrt2, 1e-3);
  EXPECT_NEAR(fit.semi_axes_m[2], 0.2, 1e-3);
  EXPECT_NEAR(std::abs(fit.axes_W(0, 2)), 1, 1e-4);
}

TEST(MinimumVolumeEllipsoid, KeepsAThicknessWhereThePointsHaveNone) {
  constexpr double kHalfWidth = 0.01;
  Generator random(3);
  for (const auto& [width, height, depth] :
       {std::array{0.3, 0.0, 0.3}, std::array{0.0, 0.0, 0.3}, std::array{0.0, 0.0, 0.0},
        std::array{0.3, 1e-9, 0.3}, std::array{0.3, 0.3, 0.0}}) {
    const SixPoints points =
        detection_points(width, height, depth, random.rotation(), random.uniform_vector(-5, 5));
    const Ellipsoid fit = minimum_volume_ellipsoid(points, kHalfWidth);
    EXPECT_TRUE(fit.axes_W.isUnitary(1e-9));
    EXPECT_GE(fit.semi_axes_m.minCoeff(), kHalfWidth / std::numbers::sqrt3 * (1 - 1e-3));
    EXPECT_LE(fit.semi_axes_m.maxCoeff(), 0.5);
    for (const Vector3d& p : points) EXPECT_LE(level(fit, p), 1 + 1e-9);
  }
}

TEST(MinimumVolumeEllipsoid, TakesNoPointsAndNoThickness) {
  EXPECT_TRUE(minimum_volume_ellipsoid({}, 0.01).semi_axes_m.isConstant(0.01, 1e-4));
  const SixPoints points{};
  EXPECT_GT(minimum_volume_ellipsoid(points, 0).semi_axes_m.minCoeff(), 0);
}

// Closest surface point by a grid over the angles that is refined around its best node.
double brute_force_distance(const Ellipsoid& ellipsoid, const Vector3d& p_W) {
  const Vector3d p = ellipsoid.axes_W.transpose() * (p_W - ellipsoid.centre_W);
  double best = std::numeric_limits<double>::infinity(), best_u = 0, best_v = 0;
  double u0 = 0, v0 = 0, span_u = std::numbers::pi, span_v = std::numbers::pi / 2;
  constexpr int kNodes = 40;
  for (int zoom = 0; zoom < 14; ++zoom) {
    for (int i = -kNodes; i <= kNodes; ++i) {
      for (int j = -kNodes; j <= kNodes; ++j) {
        const double u = u0 + span_u * i / kNodes, v = v0 + span_v * j / kNodes;
        const Vector3d x(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
        const double distance = (x.cwiseProduct(ellipsoid.semi_axes_m) - p).norm();
        if (distance < best) best = distance, best_u = u, best_v = v;
      }
    }
    u0 = best_u, v0 = best_v, span_u *= 0.2, span_v *= 0.2;
  }
  return best;
}

Ellipsoid random_ellipsoid(Generator& random) {
  Ellipsoid ellipsoid;
  ellipsoid.centre_W = random.uniform_vector(-3, 3);
  ellipsoid.axes_W = random.rotation();
  ellipsoid.semi_axes_m = random.uniform_vector(0.02, 0.5);
  return ellipsoid;
}

TEST(DistanceToSurface, AgreesWithBruteForceInsideAndOutside) {
  Generator random(4);
  int inside = 0;
  for (int k = 0; k < 150; ++k) {
    const Ellipsoid ellipsoid = random_ellipsoid(random);
    const double reach = k % 2 == 0 ? 0.3 : 2.0;
    const Vector3d p = ellipsoid.centre_W + random.uniform_vector(-reach, reach);
    const bool is_inside = level(ellipsoid, p) < 1;
    inside += is_inside;
    const double expected = brute_force_distance(ellipsoid, p) * (is_inside ? -1 : 1);
    EXPECT_NEAR(distance_to_surface(ellipsoid, p).distance_m, expected, 1e-6);
  }
  EXPECT_GT(inside, 10);
}

TEST(DistanceToSurface, AgreesWithBruteForceOnPlanesOfSymmetry) {
  Generator random(5);
  for (const Vector3d& axes : {Vector3d(0.5, 0.3, 0.1), Vector3d(0.3, 0.3, 0.1),
                               Vector3d(0.3, 0.1, 0.1), Vector3d(0.3, 0.3, 0.3)}) {
    for (int k = 0; k < 27; ++k) {
      Ellipsoid ellipsoid = random_ellipsoid(random);
      ellipsoid.semi_axes_m = axes;
      // Every combination of coordinates at 0, inside and outside.
      const int x = k % 3, y = k / 3 % 3, z = k / 9;
      const Vector3d p(0.2 * x, 0.15 * y, 0.08 * z);
      const Vector3d p_W = ellipsoid.centre_W + ellipsoid.axes_W * p;
      const SurfaceDistance surface = distance_to_surface(ellipsoid, p_W);
      EXPECT_NEAR(std::abs(surface.distance_m), brute_force_distance(ellipsoid, p_W), 1e-6)
          << axes.transpose() << " at " << p.transpose();
      EXPECT_NEAR(surface.gradient_W.norm(), 1, 1e-12);
    }
  }
}

TEST(DistanceToSurface, GradientAgreesWithFiniteDifferences) {
  Generator random(6);
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 200; ++k) {
    const Ellipsoid ellipsoid = random_ellipsoid(random);
    const Vector3d p = ellipsoid.centre_W + random.uniform_vector(-1, 1);
    if (level(ellipsoid, p) < 1) continue;  // inside, the distance has ridges
    const SurfaceDistance surface = distance_to_surface(ellipsoid, p);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = kStep * Vector3d::Unit(axis);
      const double slope = (distance_to_surface(ellipsoid, p + step).distance_m -
                            distance_to_surface(ellipsoid, p - step).distance_m) /
                           (2 * kStep);
      EXPECT_NEAR(surface.gradient_W[axis], slope, 1e-5);
    }
  }
}

TEST(DistanceToSurface, OfASphereIsTheDistanceFromTheCentreLessTheRadius) {
  const Ellipsoid ball = sphere({1, 2, 3}, 0.1);
  const SurfaceDistance outside = distance_to_surface(ball, {4, 2, 3});
  EXPECT_NEAR(outside.distance_m, 2.9, 1e-12);
  EXPECT_TRUE(outside.gradient_W.isApprox(Vector3d::UnitX()));
  EXPECT_NEAR(distance_to_surface(ball, {1, 2.04, 3}).distance_m, -0.06, 1e-12);
  EXPECT_NEAR(distance_to_surface(ball, {1, 2, 3}).distance_m, -0.1, 1e-12);
  EXPECT_NEAR(distance_to_surface(ball, {1e6 + 1, 2, 3}).distance_m, 1e6 - 0.1, 1e-6);
}

TEST(DistanceToSurface, IsFiniteForEllipsoidsWithoutExtent) {
  Generator random(7);
  for (const Vector3d& axes : {Vector3d(0, 0, 0), Vector3d(0.3, 0.3, 0), Vector3d(0.3, 0, 0)}) {
    Ellipsoid ellipsoid;
    ellipsoid.semi_axes_m = axes;
    for (int k = 0; k < 200; ++k) {
      const Vector3d p = k == 0 ? Vector3d::Zero().eval() : random.uniform_vector(-0.5, 0.5);
      const SurfaceDistance surface = distance_to_surface(ellipsoid, p);
      EXPECT_TRUE(std::isfinite(surface.distance_m));
      EXPECT_NEAR(surface.gradient_W.norm(), 1, 1e-9);
    }
  }
  EXPECT_NEAR(distance_to_surface(sphere(Vector3d::Zero(), 0), {2, 0, 0}).distance_m, 2, 1e-5);
}

}  // namespace
}  // namespace dodge
