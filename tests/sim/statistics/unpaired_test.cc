#include "sim/statistics/unpaired.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/statistics/binomial.h"

namespace dodgesim {
namespace {

using enum Alternative;

// Fisher's p-value against "the second rate is lower": the sum over all tables with the margins of
// the one seen.
double fisher(const Proportion& first, const Proportion& second) {
  const std::int64_t successes = first.successes + second.successes;
  double sum = 0;
  for (std::int64_t k = first.successes; k <= first.trials; ++k) {
    sum += hypergeometric_pmf(k, first.trials, second.trials, successes);
  }
  return sum;
}

// SciPy's tests of boschloo_exact: values of R's package Exact.
TEST(Boschloo, AgreesWithPublishedPValues) {
  const struct {
    Proportion first, second;
    double higher;
  } published[] = {
      {{2, 10}, {7, 9}, 0.009886142},     {{5, 15}, {1, 11}, 0.9450994},
      {{5, 25}, {16, 41}, 0.05827348},    {{10, 20}, {5, 6}, 0.08565611},
      {{7, 15}, {12, 15}, 0.03410916},    {{10, 35}, {24, 61}, 0.1512882},
      {{40, 79}, {43, 53}, 0.0001615562},  // the first table of the other side, mirrored
  };
  for (const auto& [first, second, higher] : published) {
    EXPECT_NEAR(boschloo(first, second, kHigher), higher, 2e-7 * std::max(1.0, 0.1 / higher))
        << first.successes << "/" << first.trials;
  }
}

TEST(Boschloo, IsTheLargestProbabilityOfTablesWithASmallerFisherPValue) {
  const std::int64_t n1 = 6, n2 = 9;
  for (std::int64_t x1 = 0; x1 <= n1; ++x1) {
    for (std::int64_t x2 = 0; x2 <= n2; ++x2) {
      const double seen = fisher({x1, n1}, {x2, n2}) * (1 + 1e-9);
      double largest = 0;
      for (double p = 0; p <= 1; p += 1.0 / 512) {
        double sum = 0;
        for (std::int64_t y1 = 0; y1 <= n1; ++y1) {
          for (std::int64_t y2 = 0; y2 <= n2; ++y2) {
            if (fisher({y1, n1}, {y2, n2}) > seen) continue;
            sum += binomial_pmf(y1, n1, p) * binomial_pmf(y2, n2, p);
          }
        }
        largest = std::max(largest, sum);
      }
      const double p_value = boschloo({x1, n1}, {x2, n2}, kLower);
      EXPECT_NEAR(p_value, largest, 1e-4) << x1 << " " << x2;
      EXPECT_GE(p_value, largest - 1e-12);
      EXPECT_LE(p_value, seen);
    }
  }
}

TEST(Boschloo, HoldsForThousandsOfThrows) {
  // Normal approximation: its tail is good to a few per cent here.
  const Proportion first{8000, 10'000}, second{7900, 10'000};
  const double rate = 0.795, n = 1e4;
  const double z = 100 / std::sqrt(2 * n * rate * (1 - rate));
  EXPECT_NEAR(boschloo(first, second, kLower), 0.5 * std::erfc(z / std::sqrt(2)), 1e-3);
  EXPECT_GT(boschloo({3000, 3000}, {2950, 3000}, kLower), 0);
  EXPECT_LT(boschloo({3000, 3000}, {2950, 3000}, kLower), 1e-13);
}

TEST(Boschloo, MirrorsWhenGroupsOrOutcomesAreSwapped) {
  const Proportion first{11, 15}, second{4, 12}, failed_first{4, 15}, failed_second{8, 12};
  const double lower = boschloo(first, second, kLower),
               two_sided = boschloo(first, second, kDifferent);
  EXPECT_LT(lower, 0.05);
  EXPECT_GT(boschloo(first, second, kHigher), 0.9);
  EXPECT_NEAR(boschloo(second, first, kHigher), lower, 1e-9);
  EXPECT_NEAR(boschloo(failed_first, failed_second, kHigher), lower, 1e-9);
  EXPECT_NEAR(boschloo(second, first, kDifferent), two_sided, 1e-9);
  EXPECT_NEAR(boschloo(failed_first, failed_second, kDifferent), two_sided, 1e-9);
}

TEST(Boschloo, SaysNothingWithoutThrowsAndRefusesImpossibleCounts) {
  for (const Alternative alternative : {kDifferent, kLower, kHigher}) {
    EXPECT_NEAR(boschloo({0, 0}, {3, 5}, alternative), 1, 1e-12);
    EXPECT_NEAR(boschloo({3, 5}, {0, 0}, alternative), 1, 1e-12);
    EXPECT_NEAR(boschloo({0, 0}, {0, 0}, alternative), 1, 1e-12);
    EXPECT_NEAR(boschloo({5, 5}, {9, 9}, alternative), 1, 1e-12);
  }
  EXPECT_THROW(boschloo({6, 5}, {1, 2}, kDifferent), std::invalid_argument);
}

// Exact size by enumeration: a true null is rejected with no more than the level.
TEST(Boschloo, KeepsItsLevel) {
  const std::int64_t n1 = 12, n2 = 8;
  std::vector<double> p_values;
  for (std::int64_t x1 = 0; x1 <= n1; ++x1) {
    for (std::int64_t x2 = 0; x2 <= n2; ++x2) {
      p_values.push_back(boschloo({x1, n1}, {x2, n2}, kDifferent));
      EXPECT_GE(p_values.back(), 0);
      EXPECT_LE(p_values.back(), 1);
    }
  }
  for (double p = 0.01; p < 1; p += 0.01) {
    double rejected = 0;
    auto p_value = p_values.begin();
    for (std::int64_t x1 = 0; x1 <= n1; ++x1) {
      for (std::int64_t x2 = 0; x2 <= n2; ++x2) {
        if (*p_value++ <= 0.05) rejected += binomial_pmf(x1, n1, p) * binomial_pmf(x2, n2, p);
      }
    }
    EXPECT_LE(rejected, 0.05 + 1e-9) << p;
  }
}

TEST(Newcombe, SaysNothingWithoutThrowsAndRefusesImpossibleCounts) {
  EXPECT_EQ(newcombe({0, 0}, {3, 5}).lo, -1);
  EXPECT_EQ(newcombe({0, 0}, {3, 5}).hi, 1);
  EXPECT_THROW(newcombe({1, 2}, {-1, 5}), std::invalid_argument);
}

// Newcombe 1998, Statistics in Medicine 17:873, table II, method 10, 95 %.
TEST(Newcombe, AgreesWithPublishedIntervals) {
  const struct {
    Proportion first, second;
    double lo, hi;
  } published[] = {
      {{48, 80}, {56, 70}, 0.0524, 0.3339}, {{3, 10}, {9, 10}, 0.1705, 0.8090},
      {{2, 7}, {6, 7}, 0.0582, 0.8062},     {{0, 29}, {5, 56}, -0.0381, 0.1926},
      {{0, 20}, {0, 10}, -0.1611, 0.2775},  {{0, 10}, {0, 10}, -0.2775, 0.2775},
      {{0, 20}, {10, 10}, 0.6791, 1.0000},  {{0, 10}, {10, 10}, 0.6075, 1.0000},
  };
  for (const auto& [first, second, lo, hi] : published) {
    const Interval interval = newcombe(first, second);
    EXPECT_NEAR(interval.lo, lo, 5.1e-5) << second.successes << "/" << second.trials;
    EXPECT_NEAR(interval.hi, hi, 5.1e-5) << second.successes << "/" << second.trials;
    const Interval mirrored = newcombe(second, first);
    EXPECT_NEAR(mirrored.lo, -interval.hi, 1e-15);
    EXPECT_NEAR(mirrored.hi, -interval.lo, 1e-15);
  }
}

TEST(Newcombe, CoversOnAverageAsItPromises) {
  const std::int64_t n1 = 20, n2 = 30;
  double sum = 0, least = 1;
  int pairs = 0;
  for (double p1 = 0.02; p1 < 1; p1 += 0.06) {
    for (double p2 = 0.02; p2 < 1; p2 += 0.06) {
      double coverage = 0;
      for (std::int64_t x1 = 0; x1 <= n1; ++x1) {
        for (std::int64_t x2 = 0; x2 <= n2; ++x2) {
          if (!newcombe({x1, n1}, {x2, n2}).contains(p2 - p1)) continue;
          coverage += binomial_pmf(x1, n1, p1) * binomial_pmf(x2, n2, p2);
        }
      }
      sum += coverage;
      least = std::min(least, coverage);
      ++pairs;
    }
  }
  RecordProperty("mean_coverage", std::to_string(sum / pairs));
  RecordProperty("least_coverage", std::to_string(least));
  EXPECT_NEAR(sum / pairs, 0.953, 0.005);
  EXPECT_GT(least, 0.91);
}

}  // namespace
}  // namespace dodgesim
