#include "sim/events/logarithm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/random.h"

namespace dodgesim {
namespace {

TEST(NaturalLog, AgreesWithExtendedPrecisionOverTheWholeRange) {
  RandomStream random(1, 0, "log");
  for (int i = 0; i < 200000; ++i) {
    const double x = std::exp(random.uniform(-30, 30));
    const long double exact = std::log(static_cast<long double>(x));
    const double scale = std::max(1.0, std::abs(static_cast<double>(exact)));
    ASSERT_LT(std::abs(static_cast<double>(natural_log(x) - exact)), 3e-16 * scale) << x;
  }
}

TEST(NaturalLog, IsExactAtOneAndIncreasesEverywhere) {
  EXPECT_EQ(natural_log(1.0), 0.0);
  // Around the ends of the interval to which the argument is reduced, and around 1.
  for (const double centre : {0.5, std::sqrt(0.5), 1.0, std::sqrt(2.0), 2.0, 1e-3}) {
    double x = centre * (1 - 1e-13);
    double previous = natural_log(x);
    while (x < centre * (1 + 1e-13)) {
      x = std::nextafter(x, 1e9);
      ASSERT_GE(natural_log(x), previous - 2e-16);
      previous = natural_log(x);
    }
  }
}

TEST(NaturalLog, InSinglePrecisionIsRightToSingleRounding) {
  RandomStream random(2, 0, "log");
  for (int i = 0; i < 200000; ++i) {
    const auto x = static_cast<float>(std::exp(random.uniform(-60, 60)));
    const double exact = std::log(static_cast<double>(x));
    ASSERT_LT(std::abs(static_cast<double>(natural_log(x)) - exact),
              2e-7 * std::max(1.0, std::abs(exact)))
        << x;
  }
}

TEST(NaturalExp, AgreesWithTheLibrarysOverTheWholeRange) {
  RandomStream random(3, 0, "exp");
  for (int i = 0; i < 200000; ++i) {
    const double x = random.uniform(-700, 700) * (i % 2 == 0 ? 1 : 1e-3);
    ASSERT_LT(std::abs(natural_exp(x) / std::exp(x) - 1), 1e-11) << x;
  }
}

}  // namespace
}  // namespace dodgesim
