#include "sim/paper/error_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/base/random.h"
#include "sim/files/text_table.h"
#include "sim/paper/bootstrap.h"
#include "sim/statistics/quantiles.h"

namespace dodgesim {
namespace {

TEST(ErrorStatistics, AreTheTextbooks) {
  // Mean 0.5, deviations -0.4, -0.3, -0.1, 0.8.
  const auto found = error_statistics({{7, 0.4}, {3, 0.1}, {7, 1.3}, {3, 0.2}}, "test");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->detections, 4);
  EXPECT_EQ(found->throws, 2);
  EXPECT_NEAR(found->mean, 0.5, 1e-12);
  EXPECT_NEAR(found->median, 0.3, 1e-12);
  EXPECT_NEAR(found->sd, std::sqrt(0.9 / 3), 1e-12);
  EXPECT_NEAR(found->mean_deviation, 0.4, 1e-12);
  EXPECT_NEAR(found->largest_deviation, 0.8, 1e-12);
}

TEST(ErrorStatistics, OfAnOddNumberHaveTheMiddleAsMedian) {
  EXPECT_EQ(error_statistics({{0, 3.0}, {1, 1.0}, {2, 7.0}}, "test")->median, 3.0);
}

TEST(ErrorStatistics, OfNothingOrOneThing) {
  EXPECT_FALSE(error_statistics({}, "test"));
  const auto one = error_statistics({{0, 0.25}}, "test");
  EXPECT_EQ(one->sd, 0);
  EXPECT_TRUE(std::isinf(one->mean_interval.lo));
  EXPECT_TRUE(std::isinf(one->mean_interval.hi)) << "one throw knows nothing of the others";
  EXPECT_EQ(with_interval(one->mean, one->mean_interval, 2), "0.25");
}

// 1000 throws whose errors are normal: the interval of the mean is that of the textbook, and does
// not become narrower when each throw says the same thing ten times.
TEST(ErrorStatistics, TakeTheThrowsForTheSample) {
  RandomStream random(1, 0, "errors");
  std::vector<PositionError> once, ten_times;
  std::vector<double> sorted;
  for (int i = 0; i < 1000; ++i) {
    const double error_m = 1 + 0.1 * random.normal();
    once.push_back({i, error_m});
    sorted.push_back(error_m);
    for (int k = 0; k < 10; ++k) ten_times.push_back({i, error_m});
  }
  const auto a = error_statistics(once, "test"), b = error_statistics(ten_times, "test");
  const double half_width = 1.96 * a->sd / std::sqrt(1000);
  EXPECT_NEAR(a->mean_interval.half_width(), half_width, 0.1 * half_width);
  EXPECT_NEAR(b->mean_interval.half_width(), half_width, 0.1 * half_width);
  // Between order statistics, as the binomial distribution has it.
  std::sort(sorted.begin(), sorted.end());
  const Interval median = estimate_quantile(sorted, 0.5)->interval;
  EXPECT_NEAR(a->median_interval.lo, median.lo, 0.25 * half_width);
  EXPECT_NEAR(a->median_interval.hi, median.hi, 0.25 * half_width);
}

TEST(ClusterBootstrap, RepeatsItself) {
  const auto interval = [](const char* name) {
    return cluster_bootstrap(20, name, [](auto which) {
      double sum = 0;
      for (const std::size_t k : which) sum += static_cast<double>(k);
      return sum;
    });
  };
  EXPECT_EQ(interval("a").lo, interval("a").lo);
  EXPECT_NE(interval("a").lo, interval("b").lo);
  const auto of = [](std::size_t clusters) {
    return cluster_bootstrap(clusters, "a",
                             [](auto which) { return static_cast<double>(which[0]); });
  };
  EXPECT_TRUE(std::isinf(of(kLeastClusters - 1).half_width())) << "too few";
  EXPECT_TRUE(std::isfinite(of(kLeastClusters).half_width()));
  EXPECT_THROW(cluster_bootstrap(0, "a", [](auto) { return 0.0; }), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim
