#include "sim/base/weighted_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/base/random.h"
#include "tests/exponential.h"

namespace dodgesim {
namespace {

// What each thing's share comes to when every place is looked at as often.
std::vector<double> exact_shares(const WeightedChoice& choice, std::uint32_t count) {
  constexpr std::uint32_t kSteps = 4096;
  std::vector<double> share(count);
  for (std::uint32_t place = 0; place < count; ++place) {
    const auto bits =
        static_cast<std::uint32_t>(((std::uint64_t{place} << 32) + (1u << 31)) / count);
    for (std::uint32_t step = 0; step < kSteps; ++step) {
      share[choice.pick(bits, step * (1u << 20) + (1u << 19))] += 1.0 / kSteps / count;
    }
  }
  return share;
}

TEST(WeightedChoice, GivesEachThingTheShareOfItsWeight) {
  RandomStream random(1, 0, "weights");
  for (int round = 0; round < 200; ++round) {
    std::vector<double> weights;
    double sum = 0;
    const auto count = 1 + random.next_u32() % 40;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double kind = random.uniform();
      weights.push_back(kind < 0.2   ? 0
                        : kind < 0.4 ? 1
                                     : exponential(random, kind < 0.5 ? 1e-3 : 1));
      sum += weights.back();
    }
    if (sum == 0) continue;
    const std::vector<double> share = exact_shares(WeightedChoice(weights), count);
    for (std::uint32_t i = 0; i < count; ++i) {
      EXPECT_NEAR(share[i], weights[i] / sum, 1.0 / 4096) << round << " " << i;
      if (weights[i] == 0) {
        EXPECT_EQ(share[i], 0) << round << " " << i;
      }
    }
  }
}

TEST(WeightedChoice, IsEvenAmongEquals) {
  for (const double weight : {1.0, 0.1, 1e-300, 1e300}) {
    const WeightedChoice choice(std::vector<double>(7, weight));
    for (const double share : exact_shares(choice, 7)) EXPECT_NEAR(share, 1.0 / 7, 1e-3);
  }
}

}  // namespace
}  // namespace dodgesim
