#include "sim/render/primitive_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/base/random.h"
#include "sim/camera/sphere_bounds.h"

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

// A point on the surface of a cylinder of this radius and half height.
Vector3d on_cylinder(const Vector3d& size, RandomStream& random) {
  const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
  return {size.x() * std::cos(angle), size.x() * std::sin(angle),
          random.uniform(-size.z(), size.z())};
}

TEST(PrimitiveBounds, HoldEveryPointInTheImageAndOfSmallSolidsLittleElse) {
  RandomStream random(3, 0, "solid");
  int inside = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double radius = random.uniform(0.005, 0.3);
    const Vector3d size(radius, radius, random.uniform(0.005, 1));
    const Vector3d centre(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-0.5, 5));
    const PrimitiveView shown = view(mjGEOM_CYLINDER, size, centre);
    if (!shown.visible) continue;
    ImageBox seen;
    for (int i = 0; i < 500; ++i) {
      const Vector3d p_C = centre + on_cylinder(size, random);
      if (p_C.z() < kNearM) continue;
      seen.extend(kCamera.project(p_C));
    }
    const Rect touched = pixels_about(seen, 0, kCamera);
    if (touched.empty()) continue;
    ++inside;
    EXPECT_LE(shown.bounds.x0, touched.x0) << trial;
    EXPECT_LE(shown.bounds.y0, touched.y0) << trial;
    EXPECT_GE(shown.bounds.x1, touched.x1) << trial;
    EXPECT_GE(shown.bounds.y1, touched.y1) << trial;
    // The corners of the box about a distant cylinder are near its outline.
    if (centre.z() < 10 * size.norm()) continue;
    EXPECT_LE(shown.bounds.x1 - shown.bounds.x0, touched.x1 - touched.x0 + 8) << trial;
    EXPECT_LE(shown.bounds.y1 - shown.bounds.y0, touched.y1 - touched.y0 + 8) << trial;
  }
  EXPECT_GT(inside, 100);
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
