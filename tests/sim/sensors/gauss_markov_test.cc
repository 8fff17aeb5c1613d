#include "sim/sensors/gauss_markov.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodgesim {
namespace {

// Sample variance of n Gaussian values: relative standard deviation sqrt(2/n).
double four_sigma(int n) { return 4 * std::sqrt(2.0 / n); }

TEST(GaussMarkov, VarianceOfTheRandomWalkGrowsWithTime) {
  constexpr int kWalks = 4000;
  constexpr double kDensity = 0.3;
  double at_1s = 0, at_4s = 0;
  for (int n = 0; n < kWalks; ++n) {
    GaussMarkov<1> walk(kDensity, 0, 0, RandomStream(1, static_cast<std::uint64_t>(n), "test"));
    for (int i = 0; i < 10; ++i) walk.step(0.1);
    at_1s += walk.value()[0] * walk.value()[0] / kWalks;
    for (int i = 0; i < 100; ++i) walk.step(0.03);
    at_4s += walk.value()[0] * walk.value()[0] / kWalks;
  }
  EXPECT_NEAR(at_1s / (kDensity * kDensity * 1), 1, four_sigma(kWalks));
  EXPECT_NEAR(at_4s / (kDensity * kDensity * 4), 1, four_sigma(kWalks));
}

TEST(GaussMarkov, VarianceRelaxesExponentiallyToTheStationaryOne) {
  constexpr int kRuns = 4000;
  constexpr double kDensity = 0.5, kCorrelationS = 2, kTimeS = 1.5;
  double fine = 0, coarse = 0;
  for (int n = 0; n < kRuns; ++n) {
    const auto index = static_cast<std::uint64_t>(n);
    GaussMarkov<1> a(kDensity, kCorrelationS, 0, RandomStream(1, index, "fine"));
    GaussMarkov<1> b(kDensity, kCorrelationS, 0, RandomStream(1, index, "coarse"));
    for (int i = 0; i < 150; ++i) a.step(kTimeS / 150);
    b.step(kTimeS);
    fine += a.value()[0] * a.value()[0] / kRuns;
    coarse += b.value()[0] * b.value()[0] / kRuns;
  }
  const double predicted =
      0.5 * kDensity * kDensity * kCorrelationS * (1 - std::exp(-2 * kTimeS / kCorrelationS));
  EXPECT_NEAR(fine / predicted, 1, four_sigma(kRuns));
  EXPECT_NEAR(coarse / predicted, 1, four_sigma(kRuns));
}

TEST(GaussMarkov, StationaryProcessKeepsItsVarianceAndForgetsExponentially) {
  constexpr int kRuns = 4000;
  constexpr double kSigma = 0.7, kCorrelationS = 0.5, kLagS = 0.3;
  double start = 0, end = 0, product = 0;
  for (int n = 0; n < kRuns; ++n) {
    auto process = GaussMarkov<1>::stationary(
        kSigma, kCorrelationS, RandomStream(1, static_cast<std::uint64_t>(n), "test"));
    const double before = process.value()[0];
    for (int i = 0; i < 30; ++i) process.step(kLagS / 30);
    const double after = process.value()[0];
    start += before * before / kRuns;
    end += after * after / kRuns;
    product += before * after / kRuns;
  }
  const double variance = kSigma * kSigma;
  EXPECT_NEAR(start / variance, 1, four_sigma(kRuns));
  EXPECT_NEAR(end / variance, 1, four_sigma(kRuns));
  const double correlation = std::exp(-kLagS / kCorrelationS);
  EXPECT_NEAR(product / variance, correlation,
              4 * std::sqrt((1 + correlation * correlation) / kRuns));
}

TEST(GaussMarkov, ComponentsAreIndependent) {
  constexpr int kRuns = 4000;
  double product = 0;
  for (int n = 0; n < kRuns; ++n) {
    GaussMarkov<2> walk(1, 0, 1, RandomStream(1, static_cast<std::uint64_t>(n), "test"));
    walk.step(1);
    product += walk.value()[0] * walk.value()[1] / kRuns;
  }
  EXPECT_NEAR(product, 0, 4 * 2 / std::sqrt(kRuns));  // standard deviation of x y is 2
}

TEST(GaussMarkov, NoTimeNoChange) {
  GaussMarkov<3> walk(1, 0, 1, RandomStream(1, 0, "test"));
  const Eigen::Vector3d before = walk.value();
  EXPECT_EQ(walk.step(0), before);
}

}  // namespace
}  // namespace dodgesim
