#include "sim/render/triangle_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/render/tessellation.h"
#include "tests/random_pose.h"
#include "tests/sim/render/render_fixture.h"

namespace dodgesim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kTexels = 256;
constexpr double kRepeatPerM = 0.5;  // 128 texels a metre

LuminanceTexture texture() {
  return {0, Vector3d::Ones(), false, kTexels, kTexels, std::vector<float>(kTexels * kTexels)};
}

Surface textured() {
  Surface surface;
  surface.texture = 0;
  surface.texture_scale = {kRepeatPerM, -kRepeatPerM, 0};
  return surface;
}

// A plane of 8 x 6 m.
TriangleBatch plane(const Isometry3d& pose) {
  TriangleBatch batch{0, false, {}};
  append_rectangle({4, 3, 0}, textured(), pose, batch.vertices);
  return batch;
}

Shot shot_from(const Isometry3d& X_WC, double lod_bias = 0) {
  const Intrinsics camera;
  return {camera, X_WC, {0, 0, camera.width, camera.height}, lod_bias};
}

// Texel that a pixel's ray meets on the plane z = 0 of `pose`; behind the camera too.
Vector2d texel_at(const Vector2d& pixel, const Shot& shot, const Isometry3d& pose) {
  const Intrinsics& camera = shot.intrinsics;
  const Vector3d ray_C((pixel.x() - camera.cx()) / camera.f, (pixel.y() - camera.cy()) / camera.f,
                       1);
  const Isometry3d X_PC = pose.inverse() * shot.X_WC;
  const Vector3d ray = X_PC.linear() * ray_C, from = X_PC.translation();
  const Vector3d p = from - from.z() / ray.z() * ray;
  return kTexels * kRepeatPerM * p.head<2>();
}

// Of the step to the next pixel, across or down.
double texels_per_px(const Vector3d& p_W, const Shot& shot, const Isometry3d& pose) {
  constexpr double kStepPx = 1e-3;
  const Vector2d pixel = shot.intrinsics.project(shot.X_WC.inverse() * p_W);
  double most = 0;
  for (const Vector2d& step : {Vector2d(kStepPx, 0), Vector2d(0, kStepPx)}) {
    const Vector2d change = texel_at(pixel + step, shot, pose) - texel_at(pixel - step, shot, pose);
    most = std::max(most, change.norm() / (2 * kStepPx));
  }
  return most;
}

std::set<std::size_t> triangles_of(const std::vector<std::uint32_t>& vertices) {
  std::set<std::size_t> triangles;
  for (std::size_t k = 0; k < vertices.size(); k += 3) {
    EXPECT_TRUE(triangles.insert(vertices[k] / 3).second);
    EXPECT_EQ(vertices[k + 1], vertices[k] + 1);
    EXPECT_EQ(vertices[k + 2], vertices[k] + 2);
  }
  return triangles;
}

// Texels per pixel from which on another level has a part: between the levels 0 and 1, or nearer
// to 1.
double most_texels_per_px(bool trilinear) { return trilinear ? 1 : std::sqrt(2); }

class TextureOfTriangles : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Filters, TextureOfTriangles, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "Trilinear" : "Bilinear"; });

TEST_P(TextureOfTriangles, IsReadAtTheFinestLevelOnlyWhereNoOtherHasAPart) {
  RandomStream random(1, 0, "triangles");
  const LuminanceTexture squares = texture();
  int finest = 0, points = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Isometry3d pose = random_pose(random, 4);
    const TriangleBatch batch = plane(pose);
    const Shot shot = shot_from(random_pose(random, 4), -2 * random.uniform());
    TriangleChoice choice;
    TriangleChooser(batch, &squares, GetParam()).choose(shot, choice);
    for (const std::size_t triangle : triangles_of(choice.finest)) {
      ++finest;
      const Vertex* const v = &batch.vertices[3 * triangle];
      double a = random.uniform(), b = random.uniform();
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const Vector3d p_W = (1 - a - b) * v[0].position.cast<double>() +
                           a * v[1].position.cast<double>() + b * v[2].position.cast<double>();
      if ((shot.X_WC.inverse() * p_W).z() < 0.05) continue;
      ++points;
      const double texels = std::exp2(shot.lod_bias) * texels_per_px(p_W, shot, pose);
      EXPECT_LT(texels, most_texels_per_px(GetParam()));
    }
  }
  EXPECT_GT(finest, 1000);
  EXPECT_GT(points, 300);
}

// Straight ahead a pixel covers z / f: 128 texels a metre are one a pixel at f / 128.
TEST_P(TextureOfTriangles, OfAWallAheadDecidesItsDistance) {
  const LuminanceTexture squares = texture();
  const Shot shot = shot_from(Isometry3d::Identity());
  const double limit_m =
      most_texels_per_px(GetParam()) * shot.intrinsics.f / (kTexels * kRepeatPerM);
  Isometry3d pose = Isometry3d::Identity();
  TriangleChoice choice;
  pose.translation().z() = 0.94 * limit_m;
  const TriangleBatch near = plane(pose);
  TriangleChooser(near, &squares, GetParam()).choose(shot, choice);
  EXPECT_EQ(choice.finest.size(), near.vertices.size());
  EXPECT_TRUE(choice.mipmapped.empty());
  pose.translation().z() = 1.01 * limit_m;
  const TriangleBatch far = plane(pose);
  TriangleChooser(far, &squares, GetParam()).choose(shot, choice);
  EXPECT_TRUE(choice.finest.empty());
  EXPECT_EQ(choice.mipmapped.size(), far.vertices.size());
}

// A plane without borders is always read through its mip-maps.
TEST_P(TextureOfTriangles, ShowsWhatMipMapsShow) {
  RenderSpec spec;
  spec.texture_filter = GetParam() ? "trilinear" : "bilinear";
  const auto ground = [&](const char* size) {
    return Scene(std::string(kWhiteLight) +
                     "<asset><texture name='t' type='2d' builtin='flat' rgb1='.5 .5 .5' "
                     "mark='random' markrgb='1 1 1' random='.4' width='256' height='256'/>"
                     "<material name='m' texture='t' texrepeat='1 1' texuniform='true'/></asset>"
                     "<worldbody><geom type='plane' size='" +
                     size + "' material='m'/></worldbody>",
                 spec);
  };
  Scene parts = ground("40 40 1"), whole = ground("0 0 1");
  Isometry3d X_WC = Isometry3d::Identity();
  X_WC.linear() << 0, -0.5, std::sqrt(0.75), -1, 0, 0, 0, -std::sqrt(0.75), -0.5;
  for (const double height_m : {0.5, 1.5, 4.0}) {
    X_WC.translation() = Vector3d(0.3, 0.2, height_m);
    const Image a = parts.render(X_WC), b = whole.render(X_WC);
    double largest = 0;
    for (int y = 60; y < a.camera.height; ++y) {  // above, one of them ends
      for (int x = 0; x < a.camera.width; ++x) {
        largest = std::max(largest, std::abs(a.at(x, y) - b.at(x, y)));
      }
    }
    EXPECT_LT(largest, 2e-3) << height_m;
  }
}

TEST(TriangleChoice, LeavesOutTheFarSidesOfSolidsAlone) {
  TriangleBatch box{-1, true, {}};
  append_box({0.2, 0.3, 0.4}, {}, Isometry3d(Eigen::Translation3d(0, 0, 2)), box.vertices);
  const TriangleChooser chooser(box, nullptr, false);
  TriangleChoice choice;
  chooser.choose(shot_from(Isometry3d::Identity()), choice);
  const std::set<std::size_t> ahead = triangles_of(choice.mipmapped);
  ASSERT_EQ(ahead.size(), 2u);
  for (const std::size_t triangle : ahead) {
    EXPECT_EQ(box.vertices[3 * triangle].normal.z(), -1);
  }
  chooser.choose(shot_from(Isometry3d(Eigen::Translation3d(3, 3, 0))), choice);
  EXPECT_EQ(triangles_of(choice.mipmapped).size(), 6u);
  // What is no solid may be seen from behind.
  box.solid = false;
  chooser.choose(shot_from(Isometry3d::Identity()), choice);
  EXPECT_EQ(triangles_of(choice.mipmapped).size(), 12u);
}

}  // namespace
}  // namespace dodgesim
