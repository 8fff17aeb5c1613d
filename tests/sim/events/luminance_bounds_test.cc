#include "sim/events/luminance_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/base/random.h"
#include "sim/base/vector_level.h"

namespace dodgesim {
namespace {

TEST(LuminanceBounds, AreSlightlyNarrowerThanAskedForAndNeverWider) {
  constexpr std::size_t kSize = 5000;
  constexpr double kEpsilon = 1e-3;
  RandomStream random(1, 0, "bounds");
  LuminanceBounds bounds(kSize, kEpsilon);
  std::vector<double> low, high;
  std::vector<float> luminance;
  for (std::size_t i = 0; i < kSize; ++i) {
    const double middle = std::exp(random.uniform(-9, 4));
    low.push_back((kEpsilon + middle) * std::exp(-random.uniform(0, 0.3)) - kEpsilon);
    high.push_back((kEpsilon + middle) * std::exp(random.uniform(0, 0.3)) - kEpsilon);
    bounds.set(i, low[i], high[i]);
    luminance.push_back(static_cast<float>(
        std::max(0.0, (kEpsilon + middle) * std::exp(random.uniform(-0.35, 0.35)) - kEpsilon)));
  }
  std::vector<unsigned char> may_fire(kSize);
  bounds.scan(0, kSize, luminance.data(), may_fire.data());
  int needless = 0;
  for (std::size_t i = 0; i < kSize; ++i) {
    const bool between = luminance[i] > low[i] && luminance[i] < high[i];
    if (!between) {
      EXPECT_EQ(may_fire[i], 1);
    } else {
      needless += may_fire[i];
    }
  }
  // 2^-11 of an octave on either side, of about 0.3.
  EXPECT_LT(needless, 0.02 * kSize);
}

TEST(LuminanceBounds, GiveTheSameFlagsAtEveryVectorLevel) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::size_t size : {1u, 15u, 32u, 77u, 320u}) {
    RandomStream random(size, 0, "levels");
    LuminanceBounds bounds(size + 5, 1e-3);
    std::vector<float> luminance;
    const std::vector<float> odd = {0.0f, -0.0f, -1.0f, nan, inf, -inf, 3e38f, 1e-42f};
    for (std::size_t i = 0; i < size; ++i) {
      if (random.uniform() < 0.9) bounds.set(i + 5, random.uniform(-1, 1), random.uniform(0, 3));
      luminance.push_back(random.uniform() < 0.2 ? odd[i % odd.size()]
                                                 : static_cast<float>(random.uniform(0, 2)));
    }
    std::vector<unsigned char> portable(size), wide(size);
    bounds.scan(5, size, luminance.data(), portable.data(), kPortable);
    for (int level = kAvx2; level <= widest_vector_level(); ++level) {
      bounds.scan(5, size, luminance.data(), wide.data(), level);
      EXPECT_EQ(portable, wide);
    }
    for (std::size_t i = 0; i < size; ++i) {
      if (!(luminance[i] >= 0 && luminance[i] < inf)) {
        EXPECT_EQ(portable[i], 1) << luminance[i];
      }
    }
  }
}

TEST(LuminanceBounds, WithTheLowOneAboveTheHighOneHoldNothing) {
  LuminanceBounds bounds(1, 1e-3);
  bounds.set(0, 1e299, -1e-3);
  unsigned char may_fire = 0;
  for (const float luminance : {0.0f, 1.0f, 1e9f}) {
    bounds.scan(0, 1, &luminance, &may_fire);
    EXPECT_EQ(may_fire, 1);
  }
}

}  // namespace
}  // namespace dodgesim
