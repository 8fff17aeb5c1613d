#include "sim/render/texture_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "sim/base/random.h"
#include "sim/render/surface_kernels.h"

namespace dodgesim {
namespace {

LuminanceTexture random_texture(bool cube, int width, int height, float brightest = 1) {
  RandomStream random(21, static_cast<std::uint64_t>(width * height), "texels");
  LuminanceTexture texture{};
  texture.cube = cube;
  texture.width = width;
  texture.height = height;
  const int texels = width * height * (cube ? 6 : 1);
  for (int i = 0; i < texels; ++i) {
    texture.texels.push_back(static_cast<float>(random.uniform(0, brightest)));
  }
  return texture;
}

// A texture that is read at places p, each given with the steps to the next pixel.
class Reader {
 public:
  explicit Reader(const LuminanceTexture& texture) : pyramid_(make_pyramid(texture)) {}

  float read(const Vec3& p, const Vec3& right, const Vec3& down, bool two_levels = false,
             float sharpness = 1) const {
    float x[2] = {p.x, p.x + right.x}, y[2] = {p.y, p.y + right.y}, z[2] = {p.z, p.z + right.z};
    float bx = p.x + down.x, by = p.y + down.y, bz = p.z + down.z, luminance = 1;
    const TextureOnSolid on = {pyramid_.pairs.data(),
                               pyramid_.unit,
                               pyramid_.first.data(),
                               pyramid_.width,
                               pyramid_.height,
                               pyramid_.levels - 1,
                               {1, 1, 1},
                               {0, 0, 0},
                               sharpness};
    const auto which = static_cast<std::size_t>(
        pyramid_.cube ? (two_levels ? TextureRead::kCubeTwoLevels : TextureRead::kCubeNearestLevel)
                      : (two_levels ? TextureRead::k2dTwoLevels : TextureRead::k2dNearestLevel));
    surface_kernels().texture[which](on, {x, y, z, nullptr, nullptr, nullptr},
                                     {&bx, &by, &bz, nullptr, nullptr, nullptr}, 1, &luminance);
    return luminance;
  }
  float sharp(const Vec3& p) const { return read(p, {1e-6F, 0, 0}, {0, 1e-6F, 0}); }

 private:
  TexturePyramid pyramid_;
};

double mean(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(TexturePyramid, TexelsAreWhereTheyAreAndInBetweenLinear) {
  const LuminanceTexture texture = random_texture(false, 8, 4);
  const Reader reader(texture);
  const auto texel = [&](int x, int y) {
    return texture.texels[static_cast<std::size_t>(8 * y + x)];
  };
  const auto at = [&](double x, double y) {
    return reader.sharp({static_cast<float>((x + 0.5) / 8), static_cast<float>((y + 0.5) / 4), 0});
  };
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) EXPECT_NEAR(at(x, y), texel(x, y), 2e-5) << x << ", " << y;
  }
  EXPECT_NEAR(at(2.25, 1), 0.75 * texel(2, 1) + 0.25 * texel(3, 1), 2e-5);
  EXPECT_NEAR(at(2, 1.5), 0.5 * texel(2, 1) + 0.5 * texel(2, 2), 2e-5);
  // It repeats, also with negative coordinates.
  EXPECT_NEAR(at(7.5, 3), 0.5 * texel(7, 3) + 0.5 * texel(0, 3), 2e-5);
  EXPECT_NEAR(at(-8, -4), texel(0, 0), 2e-5);
  EXPECT_NEAR(at(3, 3.5 - 4), 0.5 * texel(3, 3) + 0.5 * texel(3, 0), 2e-5);
}

TEST(TexturePyramid, TexelsBrighterThanWhiteAreKept) {
  const LuminanceTexture texture = random_texture(false, 4, 4, 7.0F);
  const Reader reader(texture);
  EXPECT_NEAR(reader.sharp({0.125F, 0.125F, 0}), texture.texels[0], 2e-4);
  EXPECT_NEAR(reader.sharp({0.875F, 0.125F, 0}), texture.texels[3], 2e-4);
}

TEST(TexturePyramid, SeenSmallItIsItsMeanWhateverItsSize) {
  for (const auto& [width, height] : {std::pair{64, 64}, {77, 50}, {1, 9}, {5, 1}, {3, 2}}) {
    const LuminanceTexture texture = random_texture(false, width, height);
    for (const bool two_levels : {false, true}) {
      EXPECT_NEAR(Reader(texture).read({0.3F, 0.6F, 0}, {1, 0, 0}, {0, 1, 0}, two_levels),
                  mean(texture.texels), 1e-4)
          << width << " x " << height;
    }
  }
}

TEST(TexturePyramid, TheLevelIsTheOneWhoseTexelsAreAsLargeAsAPixel) {
  // Stripes one texel wide: sharp while a pixel is smaller than 1.41 texels, grey beyond.
  LuminanceTexture stripes = random_texture(false, 64, 64);
  for (std::size_t i = 0; i < stripes.texels.size(); ++i) {
    stripes.texels[i] = i % 2 == 0 ? 0.0F : 1.0F;
  }
  const Reader reader(stripes);
  const auto on_white = [&](float texels_a_pixel, bool two_levels, float sharpness = 1) {
    const float step = texels_a_pixel / 64;
    return reader.read({1.5F / 64, 0.5F / 64, 0}, {step, 0, 0}, {0, 0.1F * step, 0}, two_levels,
                       sharpness);
  };
  EXPECT_NEAR(on_white(0.2F, false), 1, 1e-4);
  EXPECT_NEAR(on_white(1.40F, false), 1, 1e-4);
  EXPECT_NEAR(on_white(1.43F, false), 0.5, 1e-4);
  EXPECT_NEAR(on_white(1.43F, false, 0.5F), 1, 1e-4);  // read twice as sharply
  EXPECT_NEAR(on_white(2.7F, false, 0.5F), 1, 1e-4);
  EXPECT_NEAR(on_white(2.9F, false, 0.5F), 0.5, 1e-4);
  // Between two levels by the logarithm of a pixel's size.
  EXPECT_NEAR(on_white(1, true), 1, 1e-4);
  EXPECT_NEAR(on_white(std::exp2(0.25F), true), 0.875, 1e-4);
  EXPECT_NEAR(on_white(std::exp2(0.6F), true), 0.7, 1e-4);
  EXPECT_NEAR(on_white(2.001F, true), 0.5, 1e-4);
}

// As OpenGL numbers them and turns them (OpenGL 3.3, table 3.19).
TEST(TexturePyramid, ACubeHasItsFacesWhereOpenGlHasThem) {
  constexpr int kSize = 4;
  const LuminanceTexture texture = random_texture(true, kSize, kSize);
  const Reader reader(texture);
  const auto texel = [&](int face, int x, int y) {
    return texture.texels[static_cast<std::size_t>((face * kSize + y) * kSize + x)];
  };
  // Texel (3, 1) of each face lies at s = 0.75, t = -0.25.
  EXPECT_NEAR(reader.sharp({1, 0.25F, -0.75F}), texel(0, 3, 1), 2e-5);
  EXPECT_NEAR(reader.sharp({-1, 0.25F, 0.75F}), texel(1, 3, 1), 2e-5);
  EXPECT_NEAR(reader.sharp({0.75F, 1, -0.25F}), texel(2, 3, 1), 2e-5);
  EXPECT_NEAR(reader.sharp({0.75F, -1, 0.25F}), texel(3, 3, 1), 2e-5);
  EXPECT_NEAR(reader.sharp({0.75F, 0.25F, 1}), texel(4, 3, 1), 2e-5);
  EXPECT_NEAR(reader.sharp({-0.75F, 0.25F, -1}), texel(5, 3, 1), 2e-5);
  EXPECT_NEAR(reader.sharp({-7.5F, 2.5F, -10}), texel(5, 3, 1), 2e-5);  // only the direction counts
}

TEST(TexturePyramid, ACubesLevelIsThatOfItsTexelsOnTheFace) {
  LuminanceTexture stripes = random_texture(true, 64, 64);
  for (std::size_t i = 0; i < stripes.texels.size(); ++i) {
    stripes.texels[i] = i % 2 == 0 ? 0.0F : 1.0F;
  }
  const Reader reader(stripes);
  // Texel 41 of a row of the face +x, whose s falls with z: 32 texels for every unit of s.
  const Vec3 white = {2, 0, 2 * (1 - 41.5F / 32)};
  const auto on_white = [&](Vec3 direction, float texels) {
    const float step = 2 * texels / 32;
    return reader.read(white, {step * direction.x, step * direction.y, step * direction.z},
                       {0, 0, 0});
  };
  EXPECT_NEAR(on_white({0, 0, 1}, 1.40F), 1, 1e-4);
  EXPECT_NEAR(on_white({0, 0, 1}, 1.43F), 0.5, 1e-4);
  // Away from the cube's centre nothing moves on the face, along the direction that is read.
  const float length = std::hypot(white.x, white.z);
  EXPECT_NEAR(on_white({white.x / length, 0, white.z / length}, 3), 1, 1e-4);
  // Farther out, a texel moves by less: by z / x for a step along x.
  const float slope = -white.z / white.x;
  EXPECT_NEAR(on_white({1, 0, 0}, 1.40F / slope), 1, 1e-4);
  EXPECT_NEAR(on_white({1, 0, 0}, 1.43F / slope), 0.5, 1e-4);
}

TEST(TexturePyramid, WhatIsNoPlaceIsReadSomewhere) {
  const float inf = std::numeric_limits<float>::infinity();
  for (const bool cube : {false, true}) {
    const Reader reader(random_texture(cube, 8, 8));
    for (const float bad : {std::nanf(""), inf, -inf, 1e10F, -1e10F, -3e9F}) {
      for (const bool two_levels : {false, true}) {
        for (const Vec3& p : {Vec3{bad, 0, 0}, Vec3{0, bad, 0}, Vec3{0, 0, bad}}) {
          const float value = reader.read(p, {0.1F, 0, 0}, {0, 0.1F, 0}, two_levels);
          EXPECT_TRUE(std::isnan(value) || (value >= 0 && value <= 1)) << bad;
        }
      }
    }
  }
}

TEST(TexturePyramid, ACubeIsContinuousAcrossItsEdgesAndCorners) {
  RandomStream random(22, 0, "directions");
  for (const int size : {1, 3, 8}) {
    const Reader reader(random_texture(true, size, size));
    for (int trial = 0; trial < 3000; ++trial) {
      // On an edge or in a corner: two or three components are as large as any.
      float c[3];
      for (float& component : c) component = random.uniform() < 0.5 ? -1.0F : 1.0F;
      if (trial % 10 != 0) {
        c[static_cast<std::size_t>(random.uniform(0, 3))] =
            static_cast<float>(random.uniform(-1, 1));
      }
      float values[6];
      for (std::size_t i = 0; i < 6; ++i) {
        float moved[3] = {c[0], c[1], c[2]};
        moved[i / 2] *= i % 2 == 0 ? 1.00001F : 0.99999F;
        values[i] = reader.sharp({moved[0], moved[1], moved[2]});
      }
      for (const float value : values) EXPECT_NEAR(value, values[0], 5e-4) << size;
    }
  }
}

}  // namespace
}  // namespace dodgesim
