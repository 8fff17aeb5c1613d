#include "sim/paper/sphere_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dodgesim {
namespace {

using Eigen::Vector3d;

// From the points of the great circle that holds the camera's axis and the sphere's centre.
double length_by_points(const Vector3d& p_C, double size_m) {
  const Vector3d aside = Vector3d(p_C.x(), p_C.y(), 0).normalized();
  double least = 1e9, most = -1e9;
  for (int i = 0; i < 100000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100000;
    const Vector3d point =
        p_C + 0.5 * size_m * (std::cos(angle) * aside + std::sin(angle) * Vector3d::UnitZ());
    least = std::min(least, point.dot(aside) / point.z());
    most = std::max(most, point.dot(aside) / point.z());
  }
  return most - least;
}

TEST(SphereOutline, IsAsLongAsItsPointsAreApart) {
  for (const Vector3d& p_C : {Vector3d(0.4, 0, 1), Vector3d(-0.5, 0.3, 0.8), Vector3d(0.1, 0, 2)}) {
    for (const double size_m : {0.05, 0.3}) {
      EXPECT_NEAR(outline_length(p_C, size_m), length_by_points(p_C, size_m), 1e-6);
    }
  }
}

TEST(SphereOutline, IsLongerOffTheAxis) {
  EXPECT_NEAR(outline_length({0, 0, 1}, 0.1), 0.1, 0.0002);
  // A small sphere at 30 degrees: stretched by 1 / cos^2, at a distance that is 1 / cos as great.
  EXPECT_NEAR(outline_length({std::tan(std::numbers::pi / 6), 0, 1}, 0.001),
              0.001 / std::sqrt(0.75), 1e-8);
}

TEST(Unstretched, IsWhereTheSphereIs) {
  for (const Vector3d& p_C : {Vector3d(0.4, 0, 1), Vector3d(-0.5, 0.3, 0.8), Vector3d(0, 0, 0.4)}) {
    for (const double size_m : {0.05, 0.3}) {
      const double flat_depth_m = size_m / outline_length(p_C, size_m);
      const Vector3d flat_p_C = p_C * flat_depth_m / p_C.z();
      EXPECT_LT((unstretched(flat_p_C, size_m) - p_C).norm(), 1e-6) << p_C.transpose();
    }
  }
}

}  // namespace
}  // namespace dodgesim
