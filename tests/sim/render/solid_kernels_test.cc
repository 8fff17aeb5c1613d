#include "sim/render/solid_kernels.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "sim/base/random.h"
#include "sim/base/vector_level.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

constexpr SolidType kTypes[] = {SolidType::kEllipsoid, SolidType::kCapsule, SolidType::kCylinder,
                                SolidType::kBox};
constexpr mjtGeom kGeoms[] = {mjGEOM_ELLIPSOID, mjGEOM_CAPSULE, mjGEOM_CYLINDER, mjGEOM_BOX};

Vec3 single(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Vector3d twice(const Vec3& v) { return {v.x, v.y, v.z}; }

// From somewhere outside a solid, looking about at its middle.
SolidView random_view(SolidType type, RandomStream& random) {
  SolidView v{};
  v.inverse_f = 1 / 190.0F, v.cx = 159.5F, v.cy = 119.5F;
  Vector3d size(random.uniform(0.05, 0.3), random.uniform(0.05, 0.3), random.uniform(0.05, 0.3));
  if (type == SolidType::kCapsule || type == SolidType::kCylinder) size.y() = size.x();
  v.size = single(size);
  const Vector3d eye = random.uniform(0.8, 3) *
                       Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  const Vector3d forward = -eye.normalized();
  const Vector3d right = forward.unitOrthogonal();
  v.eye = single(eye);
  v.forward = single(forward), v.right = single(right), v.down = single(forward.cross(right));
  v.margin = 0.01F;
  // A circle of 20 px about the middle of the image.
  const float conic[9] = {-1, 0, 0, 0, -1, 0, 0, 0, 400};
  std::copy(std::begin(conic), std::end(conic), v.conic);
  v.conic_x = v.cx, v.conic_y = v.cy;
  v.pieces = 1 + static_cast<int>(random.uniform(0, 4));
  return v;
}

// Everything that the kernels of a solid find in a row, one after the other.
std::vector<float> all_of(const SolidKernels& kernels, const SolidView& view, float row, int size) {
  const float column = 140;
  std::vector<std::vector<float>> points(6, std::vector<float>(static_cast<std::size_t>(size)));
  std::vector<float> all, t(static_cast<std::size_t>(size));
  std::vector<int> face(static_cast<std::size_t>(size));
  const auto append = [&all](const auto& values) {
    all.insert(all.end(), values.begin(), values.end());
  };
  for (int k = 0; k < kernels.faces; ++k) {
    kernels.points(view, k, column, row, size,
                   {points[0].data(), points[1].data(), points[2].data(), points[3].data(),
                    points[4].data(), points[5].data()});
    for (const auto& component : points) append(component);
  }
  kernels.entries(view, view.margin, column, row, size, {t.data(), face.data()});
  append(t), append(face);
  if (kernels.side_entries) {
    kernels.side_entries(view, column, row, size, {t.data(), face.data()});
    append(t), append(face);
  }
  kernels.outline_coverage(view, column, row, size, t.data());
  append(t);
  for (int i = 0; i < 5; ++i) {
    int counts[kMostFaces];
    all.push_back(kernels.count_rays(view, column + static_cast<float>(4 * i), row, counts));
    append(std::vector<int>(std::begin(counts), std::end(counts)));
  }
  return all;
}

TEST(SolidKernels, GiveTheSameBytesAtEveryVectorWidth) {
  if (widest_vector_level() == kPortable) GTEST_SKIP() << "no other width here";
  RandomStream random(11, 0, "solid kernels");
  for (int trial = 0; trial < 100; ++trial) {
    for (const SolidType type : kTypes) {
      const SolidView view = random_view(type, random);
      const float row = static_cast<float>(std::floor(random.uniform(90, 150)));
      const int size = 1 + static_cast<int>(random.uniform(0, 70));
      const std::vector<float> portable = all_of(solid_kernels(type, kPortable), view, row, size);
      for (int level = kAvx2; level <= widest_vector_level(); ++level) {
        const std::vector<float> wide = all_of(solid_kernels(type, level), view, row, size);
        ASSERT_EQ(wide.size(), portable.size());
        EXPECT_EQ(std::memcmp(wide.data(), portable.data(), wide.size() * sizeof(float)), 0)
            << "solid " << static_cast<int>(type) << ", level " << level << ", size " << size;
      }
    }
  }
}

// Depth at which MuJoCo finds that a pixel's ray meets the solid; -1 if it does not.
double mujoco_depth(mjtGeom geom, const SolidView& v, double larger_by, double x, double y) {
  const Vector3d d = twice(v.right) * ((x - v.cx) * v.inverse_f) +
                     twice(v.down) * ((y - v.cy) * v.inverse_f) + twice(v.forward);
  const mjtNum center[3] = {0, 0, 0}, axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  mjtNum size[3] = {v.size.x + larger_by, v.size.y + larger_by, v.size.z + larger_by};
  if (geom == mjGEOM_CAPSULE || geom == mjGEOM_CYLINDER) size[1] = size[2];
  if (geom == mjGEOM_CAPSULE) size[1] = v.size.z;  // only the radius grows
  const Vector3d eye = twice(v.eye);
  return mju_rayGeom(center, axes, size, eye.data(), d.data(), geom);
}

TEST(SolidKernels, MeetSolidsWhereMujocosRaysDo) {
  RandomStream random(12, 0, "solid kernels");
  int hits = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    for (std::size_t k = 0; k < std::size(kTypes); ++k) {
      const SolidView view = random_view(kTypes[k], random);
      const float x = static_cast<float>(random.uniform(100, 220));
      const float y = static_cast<float>(random.uniform(60, 180));
      const float larger_by = static_cast<float>(random.uniform(0, 0.05));
      float t;
      int face;
      solid_kernels(kTypes[k]).entries(view, larger_by, x, y, 1, {&t, &face});
      const double depth = mujoco_depth(kGeoms[k], view, larger_by, x, y);
      // A ray that just touches may be told either way.
      const double wider = mujoco_depth(kGeoms[k], view, larger_by + 1e-4, x, y);
      const double narrower = mujoco_depth(kGeoms[k], view, larger_by - 1e-4, x, y);
      if ((wider >= 0) != (narrower >= 0)) continue;
      ASSERT_EQ(face >= 0, depth >= 0) << "solid " << k << ", trial " << trial;
      if (face < 0) continue;
      ++hits;
      // Where a round solid is grazed its depth hardly depends on anything but rounding.
      EXPECT_NEAR(t, depth, 2e-3) << "solid " << k << ", trial " << trial;
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(SolidKernels, MeetABoxAndACylinderAlongTheirAxesWhateverTheSignsOfZeros) {
  for (const SolidType type : {SolidType::kBox, SolidType::kCylinder}) {
    for (const float zero : {0.0F, -0.0F}) {
      SolidView view{};
      view.inverse_f = 0.01F;
      view.right = {zero, 1, zero}, view.down = {zero, zero, 1}, view.forward = {-1, zero, zero};
      view.eye = {2, zero, zero};
      view.size = {0.5F, 0.5F, 0.4F};
      float t[3];
      int face[3];
      solid_kernels(type).entries(view, 0, -1, 0, 3, {t, face});
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(face[i], 0);
        EXPECT_NEAR(t[i], 1.5, 1e-3);
      }
    }
  }
}

TEST(SolidKernels, ARayAlongACapMeetsNoPointOutsideTheCylinder) {
  SolidView view{};
  view.inverse_f = 0.01F;
  view.right = {0, 1, 0}, view.down = {0, 0, 1}, view.forward = {-1, 0, 0};
  view.eye = {2, 0, 0.5F};
  view.size = {0.3F, 0.3F, 0.5F};
  float p[3], n[3];
  for (const float row : {0.0F, 1e-30F, 1e-6F}) {
    solid_kernels(SolidType::kCylinder)
        .points(view, 1, 0, row, 1, {p, p + 1, p + 2, n, n + 1, n + 2});
    for (const float component : p) EXPECT_LE(std::abs(component), 0.51F) << row;
  }
}

// A pixel's ray, from where the camera is to a point of the face, must pass the pixel.
TEST(SolidKernels, PointsLieOnTheRayOnTheSurfaceAndHaveNormalsThatPointOut) {
  RandomStream random(13, 0, "solid kernels");
  int checked = 0;
  for (int trial = 0; trial < 500; ++trial) {
    for (const SolidType type : kTypes) {
      const SolidView view = random_view(type, random);
      const float x = static_cast<float>(random.uniform(130, 190));
      const float y = static_cast<float>(random.uniform(90, 150));
      float t;
      int face;
      const SolidKernels& kernels = solid_kernels(type);
      kernels.entries(view, 0, x, y, 1, {&t, &face});
      if (face < 0) continue;
      float p[3], n[3];
      kernels.points(view, face, x, y, 1, {p, p + 1, p + 2, n, n + 1, n + 2});
      const Vector3d point(p[0], p[1], p[2]), normal(n[0], n[1], n[2]);
      const Vector3d d = twice(view.right) * ((x - view.cx) * view.inverse_f) +
                         twice(view.down) * ((y - view.cy) * view.inverse_f) + twice(view.forward);
      EXPECT_LT((point - (twice(view.eye) + t * d)).norm(), 1e-4);
      EXPECT_NEAR(normal.norm(), 1, 1e-5);
      EXPECT_LT(normal.dot(d), 1e-2);  // towards the camera
      EXPECT_GT(normal.dot(point), 0);
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

// Of a circle of 20 px the part within a pixel, by 400 x 400 points of it.
double circle_part(double x, double y) {
  constexpr int kPoints = 400;
  int inside = 0;
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      inside += std::hypot(x + (i + 0.5) / kPoints - 0.5, y + (j + 0.5) / kPoints - 0.5) < 20;
    }
  }
  return static_cast<double>(inside) / (kPoints * kPoints);
}

TEST(SolidKernels, CoverageIsTheAreaWithinTheOutline) {
  RandomStream random(14, 0, "solid kernels");
  SolidView view = random_view(SolidType::kEllipsoid, random);
  constexpr int kPixels = 50;
  for (view.pieces = 1; view.pieces <= 4; ++view.pieces) {
    for (const float row : {100.0F, 104.0F, 119.0F, 139.0F}) {
      float coverage[kPixels];
      solid_kernels(SolidType::kEllipsoid).outline_coverage(view, 135, row, kPixels, coverage);
      // Over a length w the tangent misses w^3 / (24 R); a pixel's diagonal is the longest.
      const double tolerance = std::sqrt(8) / (24.0 * 20 * view.pieces * view.pieces) + 1e-3;
      for (int i = 0; i < kPixels; ++i) {
        EXPECT_NEAR(coverage[i], circle_part(135.0 + i - view.cx, row - view.cy), tolerance)
            << "pixel " << i << " of row " << row << ", " << view.pieces << " pieces";
      }
    }
  }
}

TEST(SolidKernels, OfAPixelFindTheSameInEveryRowThatHasIt) {
  RandomStream random(15, 0, "solid kernels");
  constexpr int kPixels = 130;
  for (int trial = 0; trial < 2000; ++trial) {
    const SolidType type = kTypes[static_cast<std::size_t>(trial % 4)];
    SolidView view = random_view(type, random);
    view.conic_x = static_cast<float>(random.uniform(-20, 150));
    view.conic[8] = static_cast<float>(std::pow(random.uniform(5, 120), 2));
    const float row = static_cast<float>(std::floor(random.uniform(90, 150)));
    const auto skipped = static_cast<std::size_t>(random.uniform(1, kPixels));
    const SolidKernels& kernels = solid_kernels(type);
    const auto found = [&](std::size_t from) {
      std::vector<float> outline(kPixels), t(kPixels);
      std::vector<int> face(kPixels);
      const auto column = static_cast<float>(from);
      const int size = kPixels - static_cast<int>(from);
      kernels.outline_coverage(view, column, row, size, outline.data() + from);
      kernels.entries(view, 0, column, row, size, {t.data() + from, face.data() + from});
      outline.insert(outline.end(), t.begin(), t.end());
      outline.insert(outline.end(), face.begin(), face.end());
      return outline;
    };
    const std::vector<float> whole = found(0), part = found(skipped);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      if (i % kPixels < skipped) continue;
      ASSERT_EQ(part[i], whole[i]) << i << " from " << skipped;
    }
  }
}

TEST(SolidKernels, RaysOfAPixelAreCountedByTheFaceTheyMeet) {
  SolidView view{};
  view.inverse_f = 0.01F;
  view.right = {0, 1, 0}, view.down = {0, 0, 1}, view.forward = {-1, 0, 0};
  view.eye = {2, 0, 0.5F};
  view.size = {1, 0.005F, 0.4F};  // its front is one pixel wide at the depth of 1 m
  const SolidKernels& box = solid_kernels(SolidType::kBox);
  int counts[kMostFaces];
  // The pixel (0, y) sees the front of the box from edge to edge, at z = 0.5 + y / 100.
  EXPECT_NEAR(box.count_rays(view, 0, -20, counts), 1, 1e-6);
  EXPECT_EQ(counts[0], kRaysPerPixel);
  // A quarter of the pixel is above its upper edge z = 0.4, where the top is seen at a distance.
  EXPECT_NEAR(box.count_rays(view, 0, -10.25F, counts), 1, 1e-6);
  EXPECT_EQ(counts[0], 3 * kRaysPerPixel / 4);
  EXPECT_NEAR(counts[2], 0.25 * kRaysPerPixel, 1);  // farther away, thus narrower
  // Half of the pixel is beside it.
  box.count_rays(view, 0.5F, -20, counts);
  EXPECT_EQ(counts[0], kRaysPerPixel / 2);
  EXPECT_EQ(counts[1] + counts[2], 0);
  EXPECT_EQ(box.count_rays(view, 30, -20, counts), 0);
  EXPECT_EQ(counts[0] + counts[1] + counts[2], 0);
}

}  // namespace
}  // namespace dodgesim
