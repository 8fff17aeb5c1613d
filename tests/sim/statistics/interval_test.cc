#include "sim/statistics/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "sim/statistics/binomial.h"

namespace dodgesim {
namespace {

// Newcombe 1998 (Statistics in Medicine 17:857), table I, method 3 (score without continuity
// correction), 95 %.
TEST(Wilson, AgreesWithPublishedIntervals) {
  const struct {
    int successes, trials;
    double lo, hi;
  } published[] = {
      {81, 263, 0.2553, 0.3662},
      {15, 148, 0.0624, 0.1605},
      {0, 20, 0.0000, 0.1611},
      {1, 29, 0.0061, 0.1718},
  };
  for (const auto& [successes, trials, lo, hi] : published) {
    const Interval interval = wilson(successes, trials);
    EXPECT_NEAR(interval.lo, lo, 5e-5) << successes << "/" << trials;
    EXPECT_NEAR(interval.hi, hi, 5e-5) << successes << "/" << trials;
  }
}

TEST(Wilson, NinetyTwoOfAHundred) {
  EXPECT_NEAR(wilson(92, 100).lo, 0.850, 5e-4);
  EXPECT_NEAR(wilson(92, 100).hi, 0.959, 5e-4);
}

TEST(Wilson, StaysInsideTheUnitIntervalAndMirrors) {
  EXPECT_EQ(wilson(0, 5).lo, 0);
  EXPECT_EQ(wilson(5, 5).hi, 1);
  EXPECT_NEAR(wilson(2, 9).lo, 1 - wilson(7, 9).hi, 1e-15);
}

TEST(Wilson, NothingIsKnownWithoutTrials) {
  EXPECT_EQ(wilson(0, 0).lo, 0);
  EXPECT_EQ(wilson(0, 0).hi, 1);
}

// The bounds are the rates from which the observed one lies z standard deviations away.
TEST(Wilson, InvertsTheScoreTest) {
  const double z = 1.6448536269514722;
  const Interval interval = wilson(13, 40, 0.9);
  for (const double p : {interval.lo, interval.hi}) {
    EXPECT_NEAR(std::abs(13.0 / 40 - p) / std::sqrt(p * (1 - p) / 40), z, 1e-12);
  }
}

TEST(Wilson, WidensWithConfidence) { EXPECT_LT(wilson(8, 10, 0.99).lo, wilson(8, 10, 0.9).lo); }

TEST(WilsonOfClusters, OfOneTrialEachIsThatOfTrials) {
  const Interval clusters = wilson_of_clusters(0.7, std::vector<std::int64_t>(10, 1));
  const Interval trials = wilson(7, 10);
  EXPECT_NEAR(clusters.lo, trials.lo, 1e-15);
  EXPECT_NEAR(clusters.hi, trials.hi, 1e-15);
}

// (4 + 4 + 4 + 12)^2 / (3 * 16 + 144) = 3.
TEST(WilsonOfClusters, CountsUnequalOnesAsFewer) {
  const Interval clusters = wilson_of_clusters(2.0 / 3, {4, 4, 4, 12});
  EXPECT_NEAR(clusters.lo, wilson(2, 3).lo, 1e-15);
  EXPECT_NEAR(clusters.hi, wilson(2, 3).hi, 1e-15);
}

TEST(WilsonOfClusters, ContainsItsShare) {
  for (int i = 0; i <= 1000; ++i) {
    EXPECT_TRUE(wilson_of_clusters(i / 1000.0, {3, 7, 7, 8}).contains(i / 1000.0)) << i;
  }
}

TEST(WilsonOfClusters, NothingIsKnownWithoutAny) {
  EXPECT_EQ(wilson_of_clusters(0.5, {}).lo, 0);
  EXPECT_EQ(wilson_of_clusters(0.5, {}).hi, 1);
  EXPECT_THROW(wilson_of_clusters(1.5, {2}), std::invalid_argument);
}

double coverage(Interval (*method)(std::int64_t, std::int64_t, double), std::int64_t trials,
                double p, double confidence) {
  double sum = 0;
  for (std::int64_t k = 0; k <= trials; ++k) {
    if (method(k, trials, confidence).contains(p)) sum += binomial_pmf(k, trials, p);
  }
  return sum;
}

// Newcombe 1998, table I, method 5 (Clopper-Pearson), 95 %.
TEST(ClopperPearson, AgreesWithPublishedIntervals) {
  const struct {
    int successes, trials;
    double lo, hi;
  } published[] = {{15, 148, 0.0578, 0.1617}, {0, 20, 0.0000, 0.1684}, {1, 29, 0.0009, 0.1776}};
  for (const auto& [successes, trials, lo, hi] : published) {
    const Interval interval = clopper_pearson(successes, trials);
    EXPECT_NEAR(interval.lo, lo, 5e-5) << successes << "/" << trials;
    EXPECT_NEAR(interval.hi, hi, 5e-5) << successes << "/" << trials;
  }
}

TEST(ClopperPearson, EndsAreExactForAllOrNothing) {
  // (1 - p)^n = 0.025 at the upper bound of no success.
  EXPECT_NEAR(clopper_pearson(0, 10).hi, 1 - std::pow(0.025, 0.1), 1e-12);
  EXPECT_EQ(clopper_pearson(0, 10).lo, 0);
  EXPECT_EQ(clopper_pearson(10, 10).hi, 1);
  EXPECT_NEAR(clopper_pearson(3, 10).lo, 1 - clopper_pearson(7, 10).hi, 1e-12);
  EXPECT_EQ(clopper_pearson(0, 0).lo, 0);
  EXPECT_EQ(clopper_pearson(0, 0).hi, 1);
}

TEST(ClopperPearson, NeverCoversTooSeldomAndWilsonCoversRightOnAverage) {
  for (const std::int64_t trials : {5, 40}) {
    double wilson_sum = 0;
    int rates = 0;
    for (double p = 0.005; p < 1; p += 0.005) {
      EXPECT_GE(coverage(clopper_pearson, trials, p, 0.9), 0.9) << trials << " at " << p;
      wilson_sum += coverage(wilson, trials, p, 0.9);
      ++rates;
    }
    EXPECT_NEAR(wilson_sum / rates, 0.9, 0.02) << trials;
  }
}

TEST(Statistics, RefuseImpossibleArguments) {
  EXPECT_THROW(wilson(-1, 5), std::invalid_argument);
  EXPECT_THROW(wilson(6, 5), std::invalid_argument);
  EXPECT_THROW(clopper_pearson(6, 5), std::invalid_argument);
  EXPECT_THROW(wilson(1, 5, 0), std::invalid_argument);
  EXPECT_THROW(wilson(1, 5, 1), std::invalid_argument);
  EXPECT_THROW(clopper_pearson(1, 5, NAN), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim
