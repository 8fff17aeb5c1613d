#include "sim/render/primitive_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodgesim {
namespace {

using Eigen::Vector3d;

constexpr double kNearM = 0.02;
const Intrinsics kCamera;

// Seen from the origin along z.
PrimitiveView view(mjtGeom type, const Vector3d& size, const Vector3d& p_C) {
  Primitive primitive{};
  primitive.type = type;
  primitive.size = size;
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
  X_WG.translation() = p_C;
  return view_primitive(primitive, X_WG, Eigen::Isometry3d::Identity(), kCamera, kNearM);
}

int pieces(mjtGeom type, const Vector3d& size, const Vector3d& p_C) {
  return view(type, size, p_C).outline_pieces;
}

// What the tangent in each of n pieces misses of a pixel that an outline of radius R crosses.
double missed_px(double radius_px, int n) { return 1 / (24 * radius_px * n * n); }

TEST(OutlinePieces, AreAsManyAsABallsOutlineIsBent) {
  constexpr double kRadiusM = 0.1, kLimitPx = 0.003;
  for (const double distance_m : {0.3, 0.7, 1.2, 1.6, 3.0, 5.0, 7.0}) {
    const int n = pieces(mjGEOM_ELLIPSOID, Vector3d::Constant(kRadiusM), {0, 0, distance_m});
    const double radius_px =
        kCamera.f * kRadiusM / std::sqrt(distance_m * distance_m - kRadiusM * kRadiusM);
    EXPECT_LE(missed_px(radius_px, n), kLimitPx) << distance_m;
    EXPECT_TRUE(n == 1 || missed_px(radius_px, n - 1) > kLimitPx) << distance_m;
  }
  EXPECT_EQ(pieces(mjGEOM_ELLIPSOID, Vector3d::Constant(kRadiusM), {0, 0, 0.3}), 1);
  EXPECT_EQ(pieces(mjGEOM_ELLIPSOID, Vector3d::Constant(kRadiusM), {0, 0, 30}), 4);
}

TEST(OutlinePieces, FollowTheSharpEndOfAFlatOutline) {
  // A disc from the side: half axes of 38 and 3.8 px, bent with 0.38 px at its ends.
  EXPECT_EQ(pieces(mjGEOM_ELLIPSOID, {0.2, 0.02, 0.2}, {0, 0, 1}), 4);
  // Of a ball aside, an ellipse that is hardly bent anywhere.
  EXPECT_EQ(pieces(mjGEOM_ELLIPSOID, Vector3d::Constant(0.1), {0.6, 0.3, 0.8}), 1);
}

TEST(OutlinePieces, AreAllWhereTheOutlineIsNoEllipse) {
  EXPECT_EQ(pieces(mjGEOM_CYLINDER, {0.1, 0.1, 0.3}, {0, 0, 1}), 4);  // two lines
  // A ball that reaches beside the camera and behind it: a hyperbola.
  const PrimitiveView near = view(mjGEOM_ELLIPSOID, Vector3d::Constant(0.5), {0.5, 0, 0.3});
  ASSERT_TRUE(near.visible);
  EXPECT_EQ(near.outline_pieces, 4);
}

}  // namespace
}  // namespace dodgesim
