#include "sim/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace dodgesim {
namespace {

TEST(RandomStream, IsAPureFunctionOfSeedThrowAndName) {
  RandomStream a(7, 3, "events/top");
  RandomStream b(7, 3, "events/top");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next_u32(), b.next_u32());
}

TEST(RandomStream, DiffersBySeedThrowAndName) {
  std::set<std::uint32_t> first;
  for (std::uint64_t seed : {0, 1, 2}) {
    for (std::uint64_t index : {0, 1, 2}) {
      for (const char* name : {"a", "b", "events/top"}) {
        first.insert(RandomStream(seed, index, name).next_u32());
      }
    }
  }
  EXPECT_EQ(first.size(), 27u);
}

TEST(RandomStream, BlocksDoNotDisturbSequentialDraws) {
  RandomStream a(1, 1, "x");
  RandomStream b(1, 1, "x");
  a.next_u32();
  b.next_u32();
  const auto block = a.block(5);
  EXPECT_EQ(a.next_u32(), b.next_u32());
  EXPECT_EQ(block, b.block(5));
  EXPECT_NE(block, b.block(6));
}

TEST(RandomStream, UniformFillsTheUnitIntervalEvenly) {
  RandomStream stream(1, 0, "uniform");
  constexpr int kDraws = 100000, kBins = 20;
  std::vector<int> bins(kBins);
  for (int i = 0; i < kDraws; ++i) {
    const double u = stream.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(u * kBins)];
  }
  double chi2 = 0;
  for (int n : bins) chi2 += std::pow(n - kDraws / kBins, 2) / (kDraws / kBins);
  EXPECT_LT(chi2, 43.8);  // 99.9 % quantile for 19 degrees of freedom
}

TEST(RandomStream, NormalHasTheMomentsOfAStandardNormal) {
  RandomStream stream(2, 0, "normal");
  constexpr int kDraws = 200000;
  double m1 = 0, m2 = 0, m4 = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double z = stream.normal();
    m1 += z / kDraws;
    m2 += z * z / kDraws;
    m4 += z * z * z * z / kDraws;
  }
  EXPECT_NEAR(m1, 0, 4 / std::sqrt(kDraws));
  EXPECT_NEAR(m2, 1, 4 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(m4, 3, 4 * std::sqrt(96.0 / kDraws));
}

}  // namespace
}  // namespace dodgesim
