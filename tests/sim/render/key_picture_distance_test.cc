// How far away what a key shows is at least: KeyPicture::nearest_m().
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/random.h"
#include "sim/render/key_picture.h"
#include "tests/sim/render/key_picture_views.h"

namespace dodgesim {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace)
using Eigen::Isometry3d;
using Eigen::Vector3d;

// The distance of the nearest point that any pixel of the region sees.
double nearest_by_force(const AnalyticScene& scene, const Isometry3d& X_WC, const Rect& region) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      const Seen s = seen(scene, small_view(), X_WC, x, y);
      if (s.inverse_length <= 0) continue;
      nearest = std::min(nearest, ray_W(small_view(), X_WC, x, y).norm() / s.inverse_length);
    }
  }
  return nearest;
}

TEST(KeyPictureDistance, BoundsTheDistanceOfWhatItShows) {
  const AnalyticScene scenes[] = {
      plane(Vector3d(0.4, -0.2, 1).normalized(), 2.8, 0.3),
      plane(Vector3d(0.2, 1, 0.1).normalized(), 1.2, 0.3),  // to a horizon
      corner_of_a_wall()};
  KeySpec spec;
  spec.max_misplacement_px = 100;
  RandomStream random(1, 2, "regions");
  int finite = 0;
  for (const AnalyticScene& scene : scenes) {
    KeyPicture key = key_of(scene, kAtOrigin, spec);
    for (int trial = 0; trial < 60; ++trial) {
      Vector3d shift(random.normal(), random.normal(), random.normal());
      const Isometry3d X_WC = pose(turn(random.uniform(-0.08, 0.08), shift), 0.02 * shift);
      const int x0 = static_cast<int>(random.uniform(0, 150)),
                y0 = static_cast<int>(random.uniform(0, 110));
      const Rect region{x0, y0, std::min(160, x0 + 1 + static_cast<int>(random.uniform(0, 60))),
                        std::min(120, y0 + 1 + static_cast<int>(random.uniform(0, 60)))};
      std::vector<float> out = blank(small_view());
      ASSERT_TRUE(key.show(X_WC, whole(small_view()), out.data()));
      const double truth = nearest_by_force(scene, X_WC, region);
      const double bound = key.nearest_m(region);
      ASSERT_LE(bound, truth);
      // The bound is along the axis, and of a cell or two more than the region.
      if (std::isfinite(bound) && &scene == &scenes[0]) {
        ASSERT_GT(bound, 0.6 * truth);
        ++finite;
      }
    }
  }
  EXPECT_GT(finite, 50);
}

TEST(KeyPictureDistance, TheSkyIsInfinitelyFarAlsoBesideAWall) {
  const AnalyticScene scene = nearer_of(half_wall(1, 0, 0.9), sky_waves(12));
  KeyPicture key = key_of(scene, kAtOrigin);
  shown(key, kAtOrigin);
  EXPECT_EQ(key.nearest_m({100, 10, 150, 100}), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(key.nearest_m({70, 10, 150, 100}), 1, 1e-6);
  EXPECT_NEAR(key.nearest_m({0, 0, 160, 120}), 1, 1e-6);
}

TEST(KeyPictureDistance, SomethingNearThatIsNarrowerThanACellCountsWhereverItIs) {
  for (int column = 60; column < 80; ++column) {
    const double x_m = (column - small_view().cx()) / kFocalPx;  // 1 m away, 2 px wide
    const AnalyticScene pole = [x_m](const Vector3d& p, const Vector3d& d) {
      const bool hit = std::abs(p.x() + d.x() * (1 - p.z()) / d.z() - x_m) < 1 / kFocalPx;
      return hit ? Seen{0.9, d.z() / (1 - p.z())} : Seen{0.1, 0.25};
    };
    KeyPicture key = key_of(pole, kAtOrigin);
    shown(key, kAtOrigin);
    const double distance_m = std::hypot(1, x_m);
    for (const Rect& region : {Rect{40, 50, 100, 52}, Rect{column, 50, column + 1, 52}}) {
      EXPECT_LE(key.nearest_m(region), distance_m + 1e-6) << column;
      EXPECT_GE(key.nearest_m(region), 1 - 1e-5) << column;
    }
    EXPECT_GE(key.nearest_m({110, 50, 150, 52}), 4 - 1e-5) << column;
  }
}

}  // namespace
}  // namespace dodgesim
