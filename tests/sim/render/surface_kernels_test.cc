#include "sim/render/surface_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "sim/base/random.h"
#include "sim/base/vector_level.h"
#include "sim/render/texture_pyramid.h"

namespace dodgesim {
namespace {

constexpr std::size_t kPoints = 75;  // no multiple of any width
using Row = std::array<float, kPoints + 1>;

struct Points {
  std::array<Row, 6> rows;
  PointRow row() {
    return {rows[0].data(), rows[1].data(), rows[2].data(),
            rows[3].data(), rows[4].data(), rows[5].data()};
  }
};

// About a point that is walked from pixel to pixel in steps of this size; unit normals.
Points random_points(double step, RandomStream& random) {
  Points points{};
  float at[3];
  for (float& component : at) component = static_cast<float>(random.uniform(-3, 3));
  for (std::size_t i = 0; i <= kPoints; ++i) {
    double n[3];
    for (double& component : n) component = random.normal();
    const double length = std::hypot(n[0], n[1], n[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] += static_cast<float>(random.uniform(-step, step));
      points.rows[k][i] = at[k];
      points.rows[3 + k][i] = static_cast<float>(n[k] / length);
    }
  }
  return points;
}

LuminanceTexture random_texture(bool cube, int width, int height, RandomStream& random) {
  LuminanceTexture texture{};
  texture.cube = cube, texture.width = width, texture.height = height;
  texture.texels.resize(static_cast<std::size_t>(width * height * (cube ? 6 : 1)));
  for (float& texel : texture.texels) texel = static_cast<float>(random.uniform());
  return texture;
}

LightsInG some_lights() {
  return {0.1F,
          {{{0, 0, -1}, 0.05F, 0.7F}, {{0.6F, 0, -0.8F}, 0, 0.3F}},
          {{{1, 2, 5}, {0, 0, -1}, 0.2F, 0, {1, 0.1F, 0.02F}, 0.1F, 0.9F},
           {{-2, 0, 5}, {0, 0, -1}, -1, 3, {1, 0, 0}, 0, 0.5F}}};
}

TEST(SurfaceKernels, GiveTheSameBytesAtEveryVectorWidth) {
  if (widest_vector_level() == kPortable) GTEST_SKIP() << "no other width here";
  RandomStream random(31, 0, "surfaces");
  const TexturePyramid pyramids[] = {make_pyramid(random_texture(false, 24, 10, random)),
                                     make_pyramid(random_texture(true, 16, 16, random))};
  for (int trial = 0; trial < 300; ++trial) {
    const double step = std::exp(random.uniform(-8, 1));
    Points here = random_points(step, random), below = random_points(step, random);
    Row value, share, t;
    for (std::size_t i = 0; i <= kPoints; ++i) {
      value[i] = static_cast<float>(random.uniform());
      share[i] = static_cast<float>(std::max(0.0, random.uniform(-0.5, 1)));
      t[i] = static_cast<float>(random.uniform(-0.2, 2));
    }
    const auto all_of = [&](const SurfaceKernels& kernels) {
      std::vector<Row> all;
      const int size = kPoints;
      kernels.light(some_lights(), 0.7F, 0.1F, here.row(), size, all.emplace_back(value).data());
      for (std::size_t read = 0; read < kTextureReads; ++read) {
        const TexturePyramid& p = pyramids[read < 2 ? 0 : 1];
        const TextureOnSolid on = {p.pairs.data(), p.unit,       p.first.data(), p.width, p.height,
                                   p.levels - 1,   {1, 2, 0.5F}, {0.3F, 0, 0},   1};
        kernels.texture[read](on, here.row(), below.row(), size, all.emplace_back(value).data());
      }
      kernels.accumulate(value.data(), share.data(), size, all.emplace_back(t).data());
      kernels.blend(value.data(), share.data(), t.data(), size, all.emplace_back(value).data());
      return all;
    };
    const std::vector<Row> portable = all_of(surface_kernels(kPortable));
    for (int level = kAvx2; level <= widest_vector_level(); ++level) {
      const std::vector<Row> wide = all_of(surface_kernels(level));
      for (std::size_t k = 0; k < wide.size(); ++k) {
        const void *a = wide[k].data(), *b = portable[k].data();
        EXPECT_EQ(std::memcmp(a, b, kPoints * sizeof(float)), 0)
            << "function " << k << ", level " << level;
      }
    }
  }
}

float lit(const LightsInG& lights, const Vec3& p, const Vec3& n) {
  Vec3 at = p, normal = n;
  float luminance = -1;
  surface_kernels().light(lights, 1, 0, {&at.x, &at.y, &at.z, &normal.x, &normal.y, &normal.z}, 1,
                          &luminance);
  return luminance;
}

TEST(SurfaceKernels, LightFallsByTheCosineAndADistantOneEverywhereAlike) {
  const LightsInG lights = {0.2F, {{{0, 0, -1}, 0.1F, 0.6F}}, {}};
  EXPECT_NEAR(lit(lights, {3, 1, 2}, {0, 0, 1}), 0.9, 1e-6);
  EXPECT_NEAR(lit(lights, {-5, 0, 0}, {0, 0.8F, 0.6F}), 0.3 + 0.6 * 0.6, 1e-6);
  EXPECT_NEAR(lit(lights, {0, 0, 0}, {0, 0, -1}), 0.3, 1e-6);  // from behind
}

TEST(SurfaceKernels, ALampFallsWithDistanceAndTowardsTheEdgeOfItsCone) {
  LightsInG lights = {0, {}, {{{0, 0, 3}, {0, 0, -1}, 0.5F, 0, {1, 0, 1}, 0, 1}}};
  EXPECT_NEAR(lit(lights, {0, 0, 1}, {0, 0, 1}), 1 / 5.0, 1e-6);
  const double away = 3 / std::sqrt(10.0);  // cosine of the angle at which the next point is seen
  EXPECT_NEAR(lit(lights, {1, 0, 0}, {0, 0, 1}), away / 11, 1e-6);
  EXPECT_EQ(lit(lights, {6, 0, 0}, {0, 0, 1}), 0);  // outside the cone of 60 degrees
  lights.lamps[0].exponent = 4;
  EXPECT_NEAR(lit(lights, {1, 0, 0}, {0, 0, 1}), std::pow(away, 5) / 11, 1e-6);
}

TEST(SurfaceKernels, AccumulatesNothingOfAFaceThatIsNotSeen) {
  const float value[] = {0.5F, NAN}, share[] = {0.25F, 0};
  float sum[] = {0.1F, 0.2F};
  surface_kernels().accumulate(value, share, 2, sum);
  EXPECT_FLOAT_EQ(sum[0], 0.225F);
  EXPECT_FLOAT_EQ(sum[1], 0.2F);
}

TEST(SurfaceKernels, BlendsByCoverageAndLeavesThePixelsThatShowNothing) {
  const float sum[] = {0.4F, 0.9F, NAN, 0.2F}, coverage[] = {0.5F, 1, 0, 0.5F};
  const float t[] = {1, 2, 1, -1};  // the last is behind the camera
  float luminance[] = {0.6F, 0.1F, 0.3F, 0.7F};
  surface_kernels().blend(sum, coverage, t, 4, luminance);
  EXPECT_FLOAT_EQ(luminance[0], 0.7F);
  EXPECT_FLOAT_EQ(luminance[1], 0.9F);
  EXPECT_FLOAT_EQ(luminance[2], 0.3F);
  EXPECT_FLOAT_EQ(luminance[3], 0.7F);
}

}  // namespace
}  // namespace dodgesim
