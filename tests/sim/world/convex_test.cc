#include "sim/world/convex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "sim/base/random.h"
#include "tests/random_pose.h"

namespace dodgesim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Closed forms for the distance from a point to a solid, in the frame of the solid.
double to_box(const Vector3d& p, const Vector3d& half) {
  return (p.cwiseAbs() - half).cwiseMax(0).norm();
}
double to_cylinder(const Vector3d& p, double radius, double half) {
  return std::hypot(std::max(0.0, p.head<2>().norm() - radius),
                    std::max(0.0, std::abs(p.z()) - half));
}
double to_segment(const Vector3d& p, double half) {
  return (p - Vector3d(0, 0, std::clamp(p.z(), -half, half))).norm();
}

TEST(ConvexTest, DistanceOfASphereAgreesWithTheClosedForms) {
  RandomStream random(1, 0, "convex");
  const Vector3d half(0.17, 0.15, 0.05);
  for (int i = 0; i < 600; ++i) {
    const Isometry3d X_AG = random_pose(random, 0.3);
    const Isometry3d X_AB = random_pose(random, i % 2 ? 2.0 : 0.3);
    const double radius = random.uniform(0.01, 0.3);
    const Convex ball = Convex::sphere(Vector3d::Zero(), radius);
    const Vector3d p_G = X_AG.inverse() * X_AB.translation();
    EXPECT_NEAR(convex_gap_m(Convex::box(X_AG, half), ball, X_AB),
                std::max(0.0, to_box(p_G, half) - radius), 1e-6);
    EXPECT_NEAR(convex_gap_m(Convex::cylinder(X_AG, 0.12, 0.03), ball, X_AB),
                std::max(0.0, to_cylinder(p_G, 0.12, 0.03) - radius), 1e-6);
    EXPECT_NEAR(convex_gap_m(Convex::capsule(X_AG, 0.04, 0.1), ball, X_AB),
                std::max(0.0, to_segment(p_G, 0.1) - 0.04 - radius), 1e-6);
  }
}

// Surface points of a solid on a fine grid of its three kinds of coordinates.
std::vector<Vector3d> box_surface(const Vector3d& half, int n) {
  std::vector<Vector3d> points;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        for (int sign = -1; sign <= 1; sign += 2) {
          Vector3d p;
          p[axis] = sign * half[axis];
          p[(axis + 1) % 3] = half[(axis + 1) % 3] * (2.0 * i / n - 1);
          p[(axis + 2) % 3] = half[(axis + 2) % 3] * (2.0 * j / n - 1);
          points.push_back(p);
        }
      }
    }
  }
  return points;
}

// The closed-form distance from every sampled point of one solid to the other: brute force.
double sampled(const std::vector<Vector3d>& points_B, const Isometry3d& X_AB,
               const std::function<double(const Vector3d&)>& distance_A) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vector3d& p_B : points_B) best = std::min(best, distance_A(X_AB * p_B));
  return best;
}

TEST(ConvexTest, DistanceBetweenSolidsAgreesWithBruteForceSampling) {
  RandomStream random(2, 0, "convex");
  const Vector3d hull(0.17, 0.17, 0.05), half(0.08, 0.05, 0.03);
  const std::vector<Vector3d> surface = box_surface(half, 80);  // a point every 2 mm
  const Convex box_a = Convex::box(Isometry3d::Identity(), hull);
  const Convex cylinder_a = Convex::cylinder(Isometry3d::Identity(), 0.17, 0.02);
  const Convex box_b = Convex::box(Isometry3d::Identity(), half);
  for (int i = 0; i < 40; ++i) {
    const Isometry3d X_AB = random_pose(random, 0.5);
    EXPECT_NEAR(convex_gap_m(box_a, box_b, X_AB),
                sampled(surface, X_AB, [&](const Vector3d& p) { return to_box(p, hull); }), 1e-3);
    EXPECT_NEAR(
        convex_gap_m(cylinder_a, box_b, X_AB),
        sampled(surface, X_AB, [](const Vector3d& p) { return to_cylinder(p, 0.17, 0.02); }), 1e-3);
  }
}

TEST(ConvexTest, DistanceOfAnEllipsoidAgreesWithBruteForceSampling) {
  RandomStream random(3, 0, "convex");
  const Vector3d axes(0.15, 0.10, 0.04), hull(0.17, 0.17, 0.05);
  std::vector<Vector3d> surface;
  for (int i = 0; i <= 300; ++i) {
    for (int j = 0; j < 600; ++j) {
      const double a = M_PI * i / 300, b = 2 * M_PI * j / 600;
      surface.push_back(axes.cwiseProduct(
          Vector3d(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a))));
    }
  }
  const Convex a = Convex::box(Isometry3d::Identity(), hull);
  const Convex b = Convex::ellipsoid(Isometry3d::Identity(), axes);
  for (int i = 0; i < 8; ++i) {
    const Isometry3d X_AB = random_pose(random, 0.5);
    EXPECT_NEAR(convex_gap_m(a, b, X_AB),
                sampled(surface, X_AB, [&](const Vector3d& p) { return to_box(p, hull); }), 1e-3);
  }
}

TEST(ConvexTest, AHullOfVerticesIsTheSolidTheySpan) {
  RandomStream random(4, 0, "convex");
  const Vector3d half(0.1, 0.05, 0.2);
  std::vector<Vector3d> corners;
  for (int k = 0; k < 8; ++k) {
    corners.push_back(half.cwiseProduct(Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  }
  const Convex a = Convex::cylinder(Isometry3d::Identity(), 0.1, 0.1);
  for (int i = 0; i < 200; ++i) {
    const Isometry3d X_AB = random_pose(random, 0.6);
    const double expected = convex_gap_m(a, Convex::box(Isometry3d::Identity(), half), X_AB);
    const Convex hull = Convex::hull(Isometry3d::Identity(), corners);
    EXPECT_NEAR(convex_gap_m(a, hull, X_AB), expected, 1e-6);
  }
}

TEST(ConvexTest, OverlappingBodiesTouch) {
  RandomStream random(6, 0, "convex");
  const Convex a = Convex::box(Isometry3d::Identity(), Vector3d(0.2, 0.2, 0.2));
  for (int i = 0; i < 200; ++i) {
    const Isometry3d X_AB = random_pose(random, 0.15);
    for (const Convex& b : {Convex::box(Isometry3d::Identity(), Vector3d(0.1, 0.02, 0.05)),
                            Convex::cylinder(Isometry3d::Identity(), 0.1, 0.02),
                            Convex::ellipsoid(Isometry3d::Identity(), Vector3d(0.1, 0.05, 0.02))}) {
      EXPECT_EQ(convex_gap_m(a, b, X_AB), 0);
    }
  }
}

TEST(ConvexTest, ABodyOfSeveralPartsReachesAsFarAsTheFarthest) {
  const auto ball = [](double x, double radius_m) {
    return Convex::sphere(Vector3d(x, 0, 0), radius_m);
  };
  const std::vector<Convex> parts = {ball(-0.2, 0.01), ball(0.1, 0.05)};
  EXPECT_NEAR(reach_m(parts, Vector3d::UnitX()), 0.15, 1e-12);
  EXPECT_NEAR(reach_m(parts, -Vector3d::UnitX()), 0.21, 1e-12);
  EXPECT_NEAR(reach_m(parts, Vector3d::UnitY()), 0.05, 1e-12);
  EXPECT_EQ(reach_m({ball(0.1, 0.05)}, -Vector3d::UnitX()), 0);  // the origin
  EXPECT_EQ(reach_m({}, Vector3d::UnitX()), 0);
}

TEST(ConvexTest, TheSphereAboutABodyOfSeveralPartsTouchesTheFarthest) {
  const Convex box = Convex::box(Isometry3d(Eigen::Translation3d(-0.3, 0, 0)), {0.03, 0, 0.04});
  const Convex ball = Convex::sphere(Vector3d(0, 0.1, 0), 0.2);
  EXPECT_NEAR(radius_m({ball}), 0.3, 1e-12);
  EXPECT_NEAR(radius_m({box, ball}), 0.35, 1e-12);
  EXPECT_EQ(radius_m({}), 0);
}

TEST(ConvexTest, TheGapBetweenBodiesOfSeveralPartsIsTheLeastBetweenTheParts) {
  RandomStream random(7, 0, "convex");
  const auto body = [&random] {
    std::vector<Convex> parts;
    for (int k = 0; k < 3; ++k) {
      parts.push_back(Convex::box(random_pose(random, 0.3), Vector3d(0.05, 0.1, 0.02)));
      parts.push_back(Convex::capsule(random_pose(random, 0.3), 0.02, 0.1));
    }
    return parts;
  };
  for (int i = 0; i < 100; ++i) {
    const std::vector<Convex> a = body(), b = body();
    const Isometry3d X_AB = random_pose(random, 2);
    double expected_m = convex_gap_m(a[0], b[0], X_AB);
    for (const Convex& part : a) {
      for (const Convex& other : b) {
        expected_m = std::min(expected_m, convex_gap_m(part, other, X_AB));
      }
    }
    const double gap_m = convex_gap_m(a, b, X_AB);
    EXPECT_NEAR(gap_m, expected_m, 1e-6);
    EXPECT_EQ(convex_gap_m(a, b, X_AB, 0.1), std::min(gap_m, 0.1));
  }
}

}  // namespace
}  // namespace dodgesim
