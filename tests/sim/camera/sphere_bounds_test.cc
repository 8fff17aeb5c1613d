#include "sim/camera/sphere_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/random.h"

namespace dodgesim {
namespace {

const Intrinsics kPinhole;  // 320 x 240

Eigen::Vector3d unit_vector(RandomStream& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

// A point of the outline: where a ray from the camera touches the sphere.
Eigen::Vector3d outline_point(const Eigen::Vector3d& centre, double radius, double angle) {
  const double distance = centre.norm();
  const Eigen::Vector3d ray = centre / distance;
  const Eigen::Vector3d u = ray.unitOrthogonal();
  const Eigen::Vector3d side = std::cos(angle) * u + std::sin(angle) * ray.cross(u);
  const double sine = radius / distance;
  return centre - radius * (sine * ray - std::sqrt(1 - sine * sine) * side);
}

TEST(SphereBounds, AreTheSmallestBoxAboutTheOutlineOfASphereInFront) {
  RandomStream random(1, 0, "sphere");
  for (int trial = 0; trial < 300; ++trial) {
    const double radius = random.uniform(0.02, 0.5);
    // Also beside the image and cut by its border.
    const Eigen::Vector3d centre(random.uniform(-4, 4), random.uniform(-3, 3),
                                 random.uniform(radius + 0.01, 5));
    ImageBox outline;
    for (int i = 0; i < 4000; ++i) {
      const double angle = 2 * std::numbers::pi * i / 4000;
      outline.extend(kPinhole.project(outline_point(centre, radius, angle)));
    }
    const ImageBox box = sphere_bounds(kPinhole, centre, radius);
    const double tolerance = 1e-4 * outline.sizes().maxCoeff() + 1e-6;
    EXPECT_TRUE((box.min() - outline.min()).cwiseAbs().maxCoeff() < tolerance) << trial;
    EXPECT_TRUE((box.max() - outline.max()).cwiseAbs().maxCoeff() < tolerance) << trial;
  }
}

TEST(SphereBounds, HoldEveryVisiblePointOfASphereBesideOrAboutTheCamera) {
  RandomStream random(2, 0, "sphere");
  int visible = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const double radius = random.uniform(0.1, 1);
    const Eigen::Vector3d centre = random.uniform(0, 2) * unit_vector(random);
    const ImageBox box = sphere_bounds(kPinhole, centre, radius);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p = centre + radius * unit_vector(random);
      if (p.z() < 1e-6) continue;
      ++visible;
      EXPECT_TRUE(box.contains(kPinhole.project(p))) << trial;
    }
  }
  EXPECT_GT(visible, 20000);
}

TEST(SphereBounds, AreEmptyForASphereBehindTheCamera) {
  EXPECT_TRUE(sphere_bounds(kPinhole, {0.3, -0.2, -1}, 0.9).isEmpty());
  EXPECT_TRUE(pixels_about(ImageBox(), 2, kPinhole).empty());
}

TEST(SphereBounds, PixelsAboutABoxAreThoseWhoseAreaComesNear) {
  const ImageBox box(Eigen::Vector2d(10.2, 20.4), Eigen::Vector2d(12.0, 22.7));
  const Rect near = pixels_about(box, 0, kPinhole);
  EXPECT_EQ(near.x0, 10);  // covers 9.5 to 10.5
  EXPECT_EQ(near.y0, 20);
  EXPECT_EQ(near.x1, 13);
  EXPECT_EQ(near.y1, 24);  // pixel 23 starts at 22.5
  const Rect wide = pixels_about(box, 2, kPinhole);
  EXPECT_EQ(wide.x0, 8);
  EXPECT_EQ(wide.y1, 26);
}

TEST(SphereBounds, PixelsAboutABoxAreClippedToTheImage) {
  const double inf = std::numeric_limits<double>::infinity();
  const Rect all =
      pixels_about({Eigen::Vector2d(-inf, -inf), Eigen::Vector2d(inf, inf)}, 2, kPinhole);
  EXPECT_EQ(all.x0, 0);
  EXPECT_EQ(all.y0, 0);
  EXPECT_EQ(all.x1, 320);
  EXPECT_EQ(all.y1, 240);
  for (const double x : {-900.0, 900.0}) {
    const ImageBox beside(Eigen::Vector2d(x, 10), Eigen::Vector2d(x + 50, 20));
    EXPECT_TRUE(pixels_about(beside, 2, kPinhole).empty());
  }
  const ImageBox entering(Eigen::Vector2d(-30, 10), Eigen::Vector2d(-1.5, 20));
  EXPECT_EQ(pixels_about(entering, 2, kPinhole).x1, 2);
}

}  // namespace
}  // namespace dodgesim
