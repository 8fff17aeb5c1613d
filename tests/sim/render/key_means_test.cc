// The kernels of key_kernels.h that make a key of what was drawn.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/base/random.h"
#include "sim/render/key_kernels.h"

namespace dodgesim {
namespace {

TEST(KeyMeans, MeansAreThoseOfBlocks) {
  RandomStream random(5, 0, "means");
  constexpr int kSize = 21, kN = 3, kFar = 30;
  std::vector<float> rows(kN * kFar);
  for (float& value : rows) value = static_cast<float>(random.uniform(0, 2));
  float sums[kSize], means[kSize];
  key_kernels().means(rows.data(), kFar, kN, kSize, sums, means);
  for (int i = 0; i + kN <= kSize; ++i) {
    double sum = 0;
    for (int k = 0; k < kN * kN; ++k)
      sum += rows[static_cast<std::size_t>(k / kN * kFar + i + k % kN)];
    EXPECT_NEAR(means[i], sum / (kN * kN), 1e-6);
  }
}

// A wave of which straight lines between its means keep, on the average over all places between
// them, sinc^2 of half the step: with steps of 0.7 rad 0.96. Sharpened, they keep it whole but for
// what the series leaves out. A flat picture stays as it is.
TEST(KeyMeans, SharpeningMakesUpForStraightLinesBetweenMeans) {
  constexpr int kSize = 60;
  const double step_rad = 0.7;
  std::vector<float> row(kSize), flat(kSize, 0.25f), across(kSize), sharp(kSize);
  for (int i = 0; i < kSize; ++i) {
    row[static_cast<std::size_t>(i)] = static_cast<float>(10 + std::sin(step_rad * i));
  }
  key_kernels().sharpen(row.data(), row.data(), row.data(), kSize, across.data(), sharp.data());
  const double half = step_rad / 2, kept = std::pow(std::sin(half) / half, 2);
  for (std::size_t i = 1; i + 1 < kSize; ++i) {
    EXPECT_NEAR((sharp[i] - 10) * kept, row[i] - 10, 0.003);
  }
  key_kernels().sharpen(flat.data(), flat.data(), flat.data(), kSize, across.data(), sharp.data());
  EXPECT_EQ(sharp, flat);
}

// Beside a bright edge the dark side would fall below 0.
TEST(KeyMeans, SharpeningKeepsTheDarkSideOfAnEdge) {
  std::vector<float> row = {1, 1, 1, 100, 100, 100}, across(6), sharp(6);
  key_kernels().sharpen(row.data(), row.data(), row.data(), 6, across.data(), sharp.data());
  EXPECT_EQ(sharp[2], 0.95f);
  EXPECT_GT(sharp[3], 100);
}

TEST(KeyMeans, LargestIsThatOfEachBlock) {
  const std::vector<float> rows = {1, 2, 3, 4, 0, 0,  //
                                   5, 0, 0, 4, 0, 0.5f};
  float largest[3];
  key_kernels().largest(rows.data(), 6, 2, 3, largest);
  EXPECT_EQ(largest[0], 5);
  EXPECT_EQ(largest[1], 4);
  EXPECT_EQ(largest[2], 0.5f);
}

}  // namespace
}  // namespace dodgesim
