#include "sim/base/normal_distribution.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodgesim {
namespace {

TEST(NormalDistribution, DensityIsTheSlopeOfTheDistributionFunction) {
  constexpr double kStep = 1e-4;
  for (double z : {-4.0, -1.0, 0.0, 0.3, 2.5}) {
    const double slope = (normal_cdf(z + kStep) - normal_cdf(z - kStep)) / (2 * kStep);
    EXPECT_NEAR(normal_density(z), slope, 1e-8) << z;
  }
}

TEST(NormalDistribution, KeepsSmallTailsAndItsHalves) {
  EXPECT_EQ(normal_cdf(0), 0.5);
  EXPECT_NEAR(normal_cdf(-10) / 7.619853024160527e-24, 1.0, 1e-12);
  EXPECT_NEAR(normal_cdf(1.5) + normal_cdf(-1.5), 1.0, 1e-15);
}

// erfc is an independent road from a quantile back to its probability.
TEST(NormalDistribution, QuantileInvertsTheDistributionFunction) {
  for (double p : {1e-15, 1e-9, 1e-3, 0.02425, 0.074, 0.3, 0.5, 0.7, 0.926, 0.999}) {
    const double z = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)) / p, 1.0, 1e-13) << p;
  }
}

}  // namespace
}  // namespace dodgesim
