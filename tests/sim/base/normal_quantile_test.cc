#include "sim/base/normal_quantile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodgesim {
namespace {

// erfc is an independent road from a quantile back to its probability.
TEST(NormalQuantile, InvertsTheNormalDistributionFunction) {
  for (double p : {1e-15, 1e-9, 1e-3, 0.02425, 0.074, 0.3, 0.5, 0.7, 0.926, 0.999}) {
    const double z = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)) / p, 1.0, 1e-13) << p;
  }
}

}  // namespace
}  // namespace dodgesim
