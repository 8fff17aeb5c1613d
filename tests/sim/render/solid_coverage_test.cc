#include "sim/render/solid_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dodgesim {
namespace {

constexpr int kRowPx = 200;
constexpr float kF = 100, kCx = 99.5F, kCy = 49.5F;  // of the camera [px]

// Camera on the x axis of a solid, which it looks at.
SolidView seen_from(float distance_m, const Vec3& size) {
  SolidView view{};
  view.inverse_f = 1 / kF, view.cx = kCx, view.cy = kCy;
  view.right = {0, 1, 0}, view.down = {0, 0, 1}, view.forward = {-1, 0, 0};
  view.eye = {distance_m, 0, 0};
  view.size = size;
  view.margin = 0.75F * (distance_m + 1) / kF;
  return view;
}

TEST(SolidCoverage, OfABoxIsItsPartOfEachPixelAndItsFrontsDepth) {
  SolidCoverage coverage;
  // Its front is 1 m away and reaches 10.3 px to the right and left.
  coverage.start(solid_kernels(SolidType::kBox), seen_from(1.5F, {0.5F, 0.103F, 0.4F}), kRowPx);
  coverage.compute(0, 49, kRowPx);
  EXPECT_TRUE(coverage.any(0));
  EXPECT_FALSE(coverage.any(1) || coverage.any(2));
  double sum = 0;
  for (int x = 0; x < kRowPx; ++x) {
    const double inside =
        std::min(x + 0.5, kCx + 10.3) - std::max(x - 0.5, kCx - 10.3);  // of the pixel [px]
    EXPECT_NEAR(coverage.whole()[x], std::max(0.0, std::min(1.0, inside)), 1.0 / 64) << x;
    EXPECT_EQ(coverage.share(0)[x], coverage.whole()[x]);
    const float depth = coverage.depth()[x];
    EXPECT_NEAR(coverage.whole()[x] > 0 ? depth : 1, 1, 1e-5) << x;
    EXPECT_NEAR(coverage.depth_at_center()[x], std::abs(x - double{kCx}) < 10.3 ? 1 : 0, 1e-5) << x;
    sum += coverage.whole()[x];
  }
  EXPECT_NEAR(sum, 20.6, 0.05);
}

TEST(SolidCoverage, WhereACentreMissesACylindersSideTheDepthIsWhereItPassesClosest) {
  SolidCoverage coverage;
  SolidView view = seen_from(2, {0.1F, 0.1F, 0.5F});
  // The side's outline: y = +-0.1 / sqrt(1 - 0.05^2) / 2 at z_C = 1, in pixels 5.006.
  const float half = 100 * 0.1F / std::sqrt(4 - 0.01F);
  const float conic[9] = {-1, 0, 0, 0, 0, 0, 0, 0, half * half};
  std::copy(std::begin(conic), std::end(conic), view.conic);
  view.conic_x = kCx, view.conic_y = kCy, view.pieces = 4;
  coverage.start(solid_kernels(SolidType::kCylinder), view, kRowPx);
  coverage.compute(0, 49, kRowPx);
  double sum = 0;
  for (int x = 0; x < kRowPx; ++x) {
    sum += coverage.whole()[x];
    if (coverage.whole()[x] == 0) continue;
    EXPECT_GT(coverage.depth()[x], 1.89) << x;  // never nearer than the front, nor than the middle
    EXPECT_LT(coverage.depth()[x], 2.01) << x;
  }
  EXPECT_NEAR(sum, 2 * half, 1e-3);
  EXPECT_TRUE(coverage.any(0));
  EXPECT_FALSE(coverage.any(1));
}

TEST(SolidCoverage, LeavesNoHolesInASolidThatTheCameraNearlyTouches) {
  SolidCoverage coverage;
  SolidView view = seen_from(0.101F, {0.1F, 0.1F, 0.1F});
  // Turned, so that it sees two faces and the edge between them.
  view.forward = {-0.8F, 0.6F, 0}, view.right = {0.6F, 0.8F, 0};
  view.eye = {0.1001F, -0.1001F, 0};
  view.margin = 0.0015F;
  coverage.start(solid_kernels(SolidType::kBox), view, kRowPx);
  int hit = 0;
  for (int y = 40; y < 60; ++y) {
    coverage.compute(0, y, kRowPx);
    for (int x = 0; x < kRowPx; ++x) {
      if (coverage.depth_at_center()[x] == 0) continue;
      ++hit;
      EXPECT_GT(coverage.whole()[x], 0) << x << ", " << y;
    }
  }
  EXPECT_GT(hit, 1000);
}

TEST(SolidCoverage, OfARowIsTheSameWithAndWithoutTheRowsAbove) {
  const SolidView view = seen_from(1.5F, {0.5F, 0.103F, 0.4F});
  SolidCoverage rows, fresh;
  rows.start(solid_kernels(SolidType::kBox), view, kRowPx);
  for (int y = 0; y < 100; ++y) {
    rows.compute(80, y, 40);
    fresh.start(solid_kernels(SolidType::kBox), view, kRowPx);
    fresh.compute(80, y, 40);
    for (int i = 0; i < 40; ++i) ASSERT_EQ(rows.whole()[i], fresh.whole()[i]) << i << ", " << y;
  }
}

}  // namespace
}  // namespace dodgesim
