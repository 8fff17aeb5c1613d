#include "sim/base/rotation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodgesim {
namespace {

using Eigen::Vector3d;

TEST(Rotation, TurnsByTheLengthOfItsVector) {
  const double quarter_rad = std::acos(0.0);
  EXPECT_TRUE((rotation({0, 0, quarter_rad}) * Vector3d(1, 0, 0)).isApprox(Vector3d(0, 1, 0)));
  const Vector3d axis(0.3, -0.2, 0.1);
  EXPECT_TRUE(rotation(axis).angularDistance(rotation(2 * axis)) < axis.norm() + 1e-12);
  EXPECT_TRUE((rotation(axis) * rotation(axis)).isApprox(rotation(2 * axis)));
}

// Down to none, w = 1 and half the vector are what is left.
TEST(Rotation, OfNextToNothingIsNextToNothing) {
  for (const double size : {0.0, 1e-100, 1e-15, 1e-9}) {
    const Eigen::Quaterniond q = rotation(size * Vector3d(0.6, 0.8, 0));
    EXPECT_NEAR(q.w(), 1, 1e-15);
    EXPECT_NEAR(q.vec().norm(), 0.5 * size, 1e-12 * size);
  }
}

}  // namespace
}  // namespace dodgesim
