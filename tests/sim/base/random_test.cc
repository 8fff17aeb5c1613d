#include "sim/base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

namespace dodgesim {
namespace {

TEST(RandomStream, IsAPureFunctionOfSeedThrowAndName) {
  RandomStream a(7, 3, "events/top");
  RandomStream b(7, 3, "events/top");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next_u32(), b.next_u32());
}

// Computed apart, from the definitions of XXH64 and Philox4x32-10: results of years ago must be
// those of today.
TEST(RandomStream, HasTheNumbersThatItAlwaysHad) {
  RandomStream stream(7, 3, "events/top");
  for (const std::uint32_t number : {0x99067501u, 0x8ced858fu, 0xe14479efu, 0x00c4470fu,
                                     0xf07b0d50u, 0x1d0c0dc0u, 0xed9bb0c3u, 0x7278414au}) {
    EXPECT_EQ(stream.next_u32(), number);
  }
  EXPECT_EQ(stream.uniform(), 0.8094390438106401);
  EXPECT_NEAR(stream.normal(), 0.8226099101431663, 1e-14);
  EXPECT_EQ(stream.block(3),
            (std::array<std::uint32_t, 4>{0x4079a54e, 0xf2a5899c, 0x571a7539, 0x90c68b8e}));
}

TEST(RandomStream, BlocksAreOtherNumbersThanTheSequentialDraws) {
  RandomStream stream(7, 3, "events/top");
  std::set<std::uint32_t> numbers;
  for (std::uint64_t counter = 0; counter < 4; ++counter) {
    for (const std::uint32_t number : stream.block(counter)) numbers.insert(number);
    for (int i = 0; i < 4; ++i) numbers.insert(stream.next_u32());
  }
  EXPECT_EQ(numbers.size(), 32u);
}

TEST(RandomStream, RefusesAThrowIndexOfMoreThan32Bits) {
  const std::uint64_t most = 0xffffffff;
  EXPECT_NO_THROW(RandomStream(1, most, "x"));
  EXPECT_THROW(RandomStream(1, most + 1, "x"), std::invalid_argument);
}

// The first numbers of SplitMix64 from the seed 1234567, as published at rosettacode.org.
TEST(MixedBits, AreThoseOfSplitMix64) {
  std::uint64_t counter = 0;
  for (const std::uint64_t number :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u,
        16408922859458223821u}) {
    EXPECT_EQ(mixed_bits(1234567, ++counter), number);
  }
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
