#include "sim/config/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace dodgesim {
namespace {

constexpr int kDraws = 20000;

std::vector<double> draw(const Distribution& distribution) {
  std::vector<double> values(kDraws);
  for (int i = 0; i < kDraws; ++i) {
    RandomStream stream(11, static_cast<std::uint64_t>(i), "test");
    values[static_cast<std::size_t>(i)] = distribution.draw(stream);
  }
  return values;
}

// Greatest distance between the empirical distribution and `cdf` (Kolmogorov-Smirnov).
template <class Cdf>
double distance_to(std::vector<double> values, Cdf cdf) {
  std::sort(values.begin(), values.end());
  double distance = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double n = static_cast<double>(values.size());
    const double p = cdf(values[i]);
    distance = std::max({distance, std::abs(p - static_cast<double>(i) / n),
                         std::abs(p - static_cast<double>(i + 1) / n)});
  }
  return distance;
}

const double kCritical = 1.63 / std::sqrt(double(kDraws));  // Kolmogorov-Smirnov at 1 %

double phi(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

TEST(Distribution, UniformIsUniform) {
  const std::vector<double> values = draw(Distribution::uniform(3, 8));
  EXPECT_LT(distance_to(values, [](double x) { return (x - 3) / 5; }), kCritical);
}

TEST(Distribution, NormalHasItsMeanAndDeviation) {
  const std::vector<double> values = draw(Distribution::normal(6, 1, -100, 100));
  EXPECT_LT(distance_to(values, [](double x) { return phi(x - 6); }), kCritical);
}

TEST(Distribution, CutNormalIsTheNormalGivenThatItLiesInside) {
  for (const auto& [mean, lo, hi] :
       {std::array{0.0, -0.5, 2.0}, std::array{2.0, 0.0, 2.0}, std::array{0.0, 0.0, 6.0}}) {
    const auto cdf = [&, mean = mean, lo = lo, hi = hi](double x) {
      return (phi(x - mean) - phi(lo - mean)) / (phi(hi - mean) - phi(lo - mean));
    };
    const std::vector<double> values = draw(Distribution::normal(mean, 1, lo, hi));
    EXPECT_LT(distance_to(values, cdf), kCritical) << mean << " " << lo << " " << hi;
    EXPECT_GE(*std::min_element(values.begin(), values.end()), lo);
    EXPECT_LE(*std::max_element(values.begin(), values.end()), hi);
  }
}

TEST(Distribution, ChoiceTakesEachValueEquallyOften) {
  std::map<double, int> counts;
  for (const double value : draw(Distribution::choice({0.1, 0.2, 0.3, 0.4}))) ++counts[value];
  ASSERT_EQ(counts.size(), 4u);
  double chi2 = 0;
  for (const auto& [value, count] : counts)
    chi2 += std::pow(count - kDraws / 4.0, 2) / (kDraws / 4.0);
  EXPECT_LT(chi2, 11.34);  // 1 %, 3 degrees of freedom
}

TEST(Distribution, QuantilesNeverLeaveTheSupport) {
  const double almost_one = std::nextafter(1.0, 0.0);
  for (const Distribution& distribution :
       {Distribution::constant(2), Distribution::uniform(1, 3), Distribution::choice({1, 2, 3}),
        Distribution::normal(2, 1e-9, 1, 3), Distribution::normal(1, 1e9, 1, 3)}) {
    for (const double p : {0.0, 0.5, almost_one}) {
      EXPECT_GE(distribution.quantile(p), distribution.quantile(0));
      EXPECT_LE(distribution.quantile(p), distribution.largest());
    }
  }
}

}  // namespace
}  // namespace dodgesim
