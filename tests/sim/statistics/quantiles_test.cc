#include "sim/statistics/quantiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "sim/base/random.h"
#include "sim/statistics/binomial.h"

namespace dodgesim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// 1, ..., n: a value is its rank.
std::vector<double> ranks(std::size_t n) {
  std::vector<double> sample(n);
  std::iota(sample.begin(), sample.end(), 1.0);
  return sample;
}

// Of an interval of ranks(n), infinite ends and all, for a continuous distribution: the number of
// values below the quantile is Bin(n, share).
double coverage(const Interval& interval, std::size_t n, double share) {
  double sum = 0;
  for (std::size_t below = 0; below <= n; ++below) {
    const auto k = static_cast<double>(below);
    if (interval.lo > k || interval.hi < k + 1) continue;
    sum += binomial_pmf(static_cast<std::int64_t>(below), static_cast<std::int64_t>(n), share);
  }
  return sum;
}

// Hyndman and Fan 1996: the k-th of n values is the quantile of (k - 1/3) / (n + 1/3).
TEST(Quantile, IsDefinition8OfHyndmanAndFan) {
  for (const std::size_t n : {1u, 2u, 7u, 50u}) {
    const std::vector<double> sample = ranks(n);
    for (std::size_t k = 1; k <= n; ++k) {
      const double share = (static_cast<double>(k) - 1.0 / 3) / (static_cast<double>(n) + 1.0 / 3);
      EXPECT_NEAR(estimate_quantile(sample, share)->value, static_cast<double>(k), 1e-9);
    }
  }
  // Places (4 + 1/3) share + 1/3: 1 5/12, 2 1/2 and beyond the last.
  const std::vector<double> sample = {2, 4, 8, 16};
  EXPECT_NEAR(estimate_quantile(sample, 0.25)->value, 2 + 5.0 / 12 * 2, 1e-12);
  EXPECT_NEAR(estimate_quantile(sample, 0.5)->value, 6, 1e-12);
  EXPECT_EQ(estimate_quantile(sample, 0.9)->value, 16);
}

TEST(Quantile, EndsAreTheExtremes) {
  const std::vector<double> sample = {3, 5, 9};
  EXPECT_EQ(estimate_quantile(sample, 0)->value, 3);
  EXPECT_EQ(estimate_quantile(sample, 1)->value, 9);
}

// Intervals of the median by ranks with their coverage in percent, as tables of the sign test list
// them (Mendenhall and others), 95 %.
TEST(Quantile, IntervalsOfTheMedianAreThePublishedOnes) {
  const struct {
    std::size_t n;
    double lo, hi, percent;
  } published[] = {{6, 1, 6, 96.9},   {7, 1, 7, 98.4},   {9, 2, 8, 96.1},   {12, 3, 10, 96.1},
                   {15, 4, 12, 96.5}, {17, 5, 13, 95.1}, {18, 5, 14, 96.9}, {20, 6, 15, 95.9}};
  for (const auto& [n, lo, hi, percent] : published) {
    const QuantileEstimate estimate = *estimate_quantile(ranks(n), 0.5);
    EXPECT_EQ(estimate.interval.lo, lo) << n;
    EXPECT_EQ(estimate.interval.hi, hi) << n;
    EXPECT_NEAR(100 * coverage(estimate.interval, n, 0.5), percent, 0.05) << n;
  }
}

// Snedecor and Cochran 1989, as in the R package statpsych.
TEST(Quantile, MedianOfAPublishedSample) {
  std::vector<double> sample = {30.2, 20.4, 15.1, 10.2, 10.5, 60.8, 20.8, 25.0, 20.7, 30.9,
                                10.8, 5.1,  50.9, 40.0, 20.9, 10.8, 0,    20.5, 50.8};
  std::sort(sample.begin(), sample.end());
  const QuantileEstimate estimate = *estimate_quantile(sample, 0.5);
  EXPECT_EQ(estimate.value, 20.7);
  EXPECT_EQ(estimate.interval.lo, 10.8);
  EXPECT_EQ(estimate.interval.hi, 30.9);
}

TEST(Quantile, IsUnboundedWhereTheSampleIsTooSmall) {
  EXPECT_FALSE(estimate_quantile({}, 0.5));
  const QuantileEstimate one = *estimate_quantile(ranks(1), 0.5);
  EXPECT_EQ(one.value, 1);
  EXPECT_EQ(one.interval.lo, -kInfinity);
  EXPECT_EQ(one.interval.hi, kInfinity);
  // 0.95^n falls to 0.025 at n = 72: until then the largest value does not bound this quantile.
  EXPECT_EQ(estimate_quantile(ranks(71), 0.95)->interval.hi, kInfinity);
  EXPECT_EQ(estimate_quantile(ranks(72), 0.95)->interval.hi, 72);
  EXPECT_EQ(estimate_quantile(ranks(71), 0.05)->interval.lo, -kInfinity);
  EXPECT_EQ(estimate_quantile(ranks(72), 0.05)->interval.lo, 1);
}

TEST(Quantile, MirrorsAndRisesWithTheShare) {
  const std::vector<double> sample = ranks(60);
  double previous = 0;
  for (double share = 0.02; share < 1; share += 0.02) {
    const QuantileEstimate estimate = *estimate_quantile(sample, share);
    const QuantileEstimate mirrored = *estimate_quantile(sample, 1 - share);
    EXPECT_NEAR(estimate.value, 61 - mirrored.value, 1e-9);
    EXPECT_EQ(estimate.interval.lo, 61 - mirrored.interval.hi) << share;
    EXPECT_GE(estimate.value, previous);
    EXPECT_TRUE(estimate.interval.contains(estimate.value)) << share;
    EXPECT_GE(coverage(estimate.interval, 60, share), 0.95);
    previous = estimate.value;
  }
}

TEST(Quantile, TakesThatWhichNeverHappenedForInfinite) {
  const std::vector<double> sample = {1, 2, 3, kInfinity, kInfinity};
  EXPECT_EQ(estimate_quantile(sample, 0.5)->value, 3);
  EXPECT_EQ(estimate_quantile(sample, 0.7)->value, kInfinity);
  EXPECT_EQ(estimate_quantile(sample, 1)->value, kInfinity);
}

TEST(Quantile, RefusesBadSamplesAndShares) {
  const std::vector<double> unsorted = {2, 1}, with_nan = {1, NAN}, only_nan = {NAN},
                            minus_infinite = {-kInfinity, 1}, good = {1, 2};
  EXPECT_THROW(estimate_quantile(unsorted, 0.5), std::invalid_argument);
  EXPECT_THROW(estimate_quantile(with_nan, 0.5), std::invalid_argument);
  EXPECT_THROW(estimate_quantile(only_nan, 0.5), std::invalid_argument);
  EXPECT_THROW(estimate_quantile(minus_infinite, 0.5), std::invalid_argument);
  EXPECT_THROW(estimate_quantile(good, -0.1), std::invalid_argument);
  EXPECT_THROW(estimate_quantile(good, 1.1), std::invalid_argument);
  EXPECT_THROW(estimate_quantile(good, NAN), std::invalid_argument);
  EXPECT_THROW(estimate_quantile(good, 0.5, 1), std::invalid_argument);
}

// Drawn from a uniform distribution, whose quantile of a share is the share.
TEST(Quantile, CoversAsItSaysAndIsMedianUnbiased) {
  RandomStream stream(7, 0, "quantile test");
  constexpr int kSamples = 8000;
  const double four_sigma = 4 * std::sqrt(0.25 / kSamples);
  for (const double share : {0.1, 0.5, 0.8}) {
    const Interval by_rank = estimate_quantile(ranks(37), share)->interval;
    int covered = 0, above = 0;
    for (int i = 0; i < kSamples; ++i) {
      std::vector<double> sample(37);
      for (double& x : sample) x = stream.uniform();
      std::sort(sample.begin(), sample.end());
      const QuantileEstimate estimate = *estimate_quantile(sample, share);
      covered += estimate.interval.contains(share);
      above += estimate.value > share;
    }
    EXPECT_NEAR(static_cast<double>(covered) / kSamples, coverage(by_rank, 37, share), four_sigma)
        << share;
    EXPECT_NEAR(static_cast<double>(above) / kSamples, 0.5, four_sigma) << share;
  }
}

}  // namespace
}  // namespace dodgesim
