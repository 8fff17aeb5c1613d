#include "sim/statistics/binomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dodgesim {
namespace {

double choose(std::int64_t n, std::int64_t k) {
  double c = 1;
  for (std::int64_t i = 1; i <= k; ++i) {
    c = c * static_cast<double>(n - k + i) / static_cast<double>(i);
  }
  return c;
}

double by_definition(std::int64_t k, std::int64_t n, double p) {
  return choose(n, k) * std::pow(p, static_cast<double>(k)) *
         std::pow(1 - p, static_cast<double>(n - k));
}

TEST(Binomial, IsTheDefinitionForFewTrials) {
  for (const std::int64_t n : {1, 2, 15, 16, 17, 40}) {
    for (const double p : {0.001, 0.3, 0.5, 0.97}) {
      double below = 0;
      for (std::int64_t k = 0; k <= n; ++k) {
        const double pmf = by_definition(k, n, p);
        EXPECT_NEAR(binomial_pmf(k, n, p), pmf, 1e-12 * pmf) << k << " of " << n << " at " << p;
        EXPECT_NEAR(binomial_upper_tail(k, n, p), 1 - below, 1e-12);
        below += pmf;
        EXPECT_NEAR(binomial_lower_tail(k, n, p), below, 1e-12);
      }
    }
  }
}

TEST(Binomial, TailsAreAccurateFarOut) {
  // P(X = 0) = 0.9^100 and the sum of the last two terms.
  EXPECT_NEAR(binomial_lower_tail(0, 100, 0.1) / std::pow(0.9, 100), 1, 1e-12);
  const double last = std::pow(0.1, 100), before = 100 * std::pow(0.1, 99) * 0.9;
  EXPECT_NEAR(binomial_upper_tail(99, 100, 0.1) / (last + before), 1, 1e-12);
}

TEST(Binomial, HoldsForMillionsOfTrials) {
  constexpr std::int64_t kTrials = 2'000'000;
  // C(2m, m) 2^-2m = (1 - 1/(8m) + 1/(128 m^2) - ...) / sqrt(pi m)
  const double m = 0.5 * kTrials;
  EXPECT_NEAR(binomial_pmf(kTrials / 2, kTrials, 0.5) * std::sqrt(M_PI * m),
              1 - 1 / (8 * m) + 1 / (128 * m * m), 1e-13);
  // The same far from the mean, from the ratios of neighbours.
  double log_ratio = 0;
  for (std::int64_t k = kTrials / 2; k < kTrials / 2 + 10000; ++k) {
    log_ratio += std::log(static_cast<double>(kTrials - k) / static_cast<double>(k + 1));
  }
  EXPECT_NEAR(log_binomial_pmf(kTrials / 2 + 10000, kTrials, 0.5) -
                  log_binomial_pmf(kTrials / 2, kTrials, 0.5),
              log_ratio, 1e-9);
}

TEST(Binomial, NothingHappensAtRateZeroAndAllAtRateOne) {
  EXPECT_EQ(binomial_pmf(0, 7, 0), 1);
  EXPECT_EQ(binomial_pmf(1, 7, 0), 0);
  EXPECT_EQ(binomial_pmf(7, 7, 1), 1);
  EXPECT_EQ(binomial_lower_tail(6, 7, 1), 0);
  EXPECT_EQ(binomial_upper_tail(1, 7, 0), 0);
  EXPECT_EQ(binomial_upper_tail(0, 7, 0), 1);
  EXPECT_EQ(binomial_pmf(-1, 7, 0.5), 0);
  EXPECT_EQ(binomial_pmf(8, 7, 0.5), 0);
}

TEST(Binomial, TableHoldsAllProbabilities) {
  for (const double p : {0.0, 0.02, 0.5, 0.999, 1.0}) {
    const std::vector<double> table = binomial_pmf_table(300, p);
    ASSERT_EQ(table.size(), 301u);
    EXPECT_NEAR(std::accumulate(table.begin(), table.end(), 0.0), 1, 1e-12);
    for (std::size_t k = 0; k < table.size(); ++k) {
      const double pmf = binomial_pmf(static_cast<std::int64_t>(k), 300, p);
      EXPECT_NEAR(table[k], pmf, 1e-11 * pmf + 1e-300);
    }
  }
}

TEST(Hypergeometric, IsTheDefinition) {
  for (std::int64_t drawn = 0; drawn <= 12; ++drawn) {
    double sum = 0;
    for (std::int64_t k = 0; k <= 5; ++k) {
      const bool possible = drawn - k >= 0 && drawn - k <= 7;
      const double pmf = possible ? choose(5, k) * choose(7, drawn - k) / choose(12, drawn) : 0;
      EXPECT_NEAR(hypergeometric_pmf(k, 5, 7, drawn), pmf, 1e-13);
      sum += hypergeometric_pmf(k, 5, 7, drawn);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
  EXPECT_EQ(hypergeometric_pmf(0, 0, 0, 0), 1);
}

// A narrow peak beside a broad and lower one in the middle.
TEST(LargestPValue, FindsNarrowPeaksNearTheEnds) {
  for (const double peak : {2e-4, 0.01, 0.4, 0.4998}) {
    const double width = std::sqrt(peak * (0.5 - peak)) / 50;
    const auto p_value = [&](double p) {
      return std::max(0.7 * std::exp(-std::pow((p - peak) / width, 2)),
                      0.6 * std::exp(-std::pow((p - 0.25) / 0.1, 2)));
    };
    EXPECT_NEAR(largest_p_value(0, 0.5, p_value), 0.7, 1e-6) << peak;
  }
}

TEST(LargestPValue, SearchesOnlyItsRange) {
  const auto identity = [](double p) { return p; };
  EXPECT_NEAR(largest_p_value(0.2, 0.3, identity), 0.3, 1e-12);
  EXPECT_NEAR(largest_p_value(0.2, 0.3, [](double p) { return 1 - p; }), 0.8, 1e-12);
  EXPECT_EQ(largest_p_value(0.3, 0.3, identity), 0.3);
}

}  // namespace
}  // namespace dodgesim
