#include "sim/statistics/interval.h"

#include <cmath>
#include <stdexcept>

#include "sim/base/normal_distribution.h"
#include "sim/statistics/binomial.h"

namespace dodgesim {

namespace {

// Of a share of n trials, which need not be whole.
Interval wilson_of_share(double p, double n, double z) {
  const double centre = p + z * z / (2 * n);
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  const double scale = 1 + z * z / n;
  // At the ends the bounds are exactly 0 and 1, which rounding would miss.
  return {p == 0 ? 0 : (centre - half) / scale, p == 1 ? 1 : (centre + half) / scale};
}

}  // namespace

void check_counts(std::int64_t successes, std::int64_t trials) {
  if (successes < 0 || successes > trials) {
    throw std::invalid_argument("Successes must lie between 0 and the number of trials.");
  }
}

void check_confidence(double confidence) {
  if (!(confidence > 0 && confidence < 1)) {
    throw std::invalid_argument("A confidence must lie between 0 and 1, both excluded.");
  }
}

Interval wilson(std::int64_t successes, std::int64_t trials, double confidence) {
  check_counts(successes, trials);
  check_confidence(confidence);
  if (trials == 0) return {0, 1};
  return wilson_of_quantile(successes, trials, normal_quantile(0.5 + 0.5 * confidence));
}

Interval wilson_of_quantile(std::int64_t successes, std::int64_t trials, double z) {
  const auto n = static_cast<double>(trials);
  return wilson_of_share(static_cast<double>(successes) / n, n, z);
}

Interval wilson_of_clusters(double share, const std::vector<std::int64_t>& sizes,
                            double confidence) {
  if (!(share >= 0 && share <= 1)) throw std::invalid_argument("A share must lie between 0 and 1.");
  check_confidence(confidence);
  if (sizes.empty()) return {0, 1};
  double sum = 0, sum_of_squares = 0;
  for (const std::int64_t size : sizes) {
    const auto m = static_cast<double>(size);
    sum += m;
    sum_of_squares += m * m;
  }
  return wilson_of_share(share, sum * sum / sum_of_squares,
                         normal_quantile(0.5 + 0.5 * confidence));
}

Interval clopper_pearson(std::int64_t successes, std::int64_t trials, double confidence) {
  check_counts(successes, trials);
  check_confidence(confidence);
  constexpr int kHalvings = 60;
  const double tail = 0.5 * (1 - confidence);
  // The rate up to which P(X >= least) stays within the tail; it rises with the rate.
  const auto rate_at = [&](std::int64_t least, double probability) {
    double lo = 0, hi = 1;
    for (int i = 0; i < kHalvings; ++i) {
      const double p = 0.5 * (lo + hi);
      (binomial_upper_tail(least, trials, p) < probability ? lo : hi) = p;
    }
    return 0.5 * (lo + hi);
  };
  return {successes == 0 ? 0 : rate_at(successes, tail),
          successes == trials ? 1 : rate_at(successes + 1, 1 - tail)};
}

}  // namespace dodgesim
