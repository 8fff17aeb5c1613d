#include "sim/statistics/quantiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/statistics/binomial.h"

namespace dodgesim {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check_sample(std::span<const double> sorted) {
  const bool has_nan = std::ranges::any_of(sorted, [](double x) { return std::isnan(x); });
  if (has_nan || !std::ranges::is_sorted(sorted) ||
      (!sorted.empty() && sorted.front() == -kInfinity)) {
    throw std::invalid_argument("A sample must ascend, without NaN and -infinity.");
  }
}

double definition_8(std::span<const double> sorted, double share) {
  const auto n = static_cast<double>(sorted.size());
  const double place = std::clamp((n + 1.0 / 3) * share + 1.0 / 3, 1.0, n);
  const auto below = static_cast<std::size_t>(place);
  const double fraction = place - std::floor(place);
  const double lower = sorted[below - 1];
  const double upper = sorted[std::min(below, sorted.size() - 1)];
  if (fraction == 0 || lower == upper) return lower;
  return lower + fraction * (upper - lower);
}

}  // namespace

std::optional<QuantileEstimate> estimate_quantile(std::span<const double> sorted, double share,
                                                  double confidence) {
  check_confidence(confidence);
  check_sample(sorted);
  if (!(share >= 0 && share <= 1)) {
    throw std::invalid_argument("The share of a quantile must lie between 0 and 1.");
  }
  if (sorted.empty()) return std::nullopt;
  const auto n = static_cast<std::int64_t>(sorted.size());
  const double tail = 0.5 * (1 - confidence);
  // The number of values below the quantile is Bin(n, share). `lower`: the largest rank with
  // P(fewer than `lower` values lie below) within the tail; 0: none. `upper`: the smallest rank
  // with P(at least `upper` values lie below) within the tail; n + 1: none.
  std::int64_t lower = 0, none = n + 1;
  while (none - lower > 1) {
    const std::int64_t rank = lower + (none - lower) / 2;
    (binomial_lower_tail(rank - 1, n, share) <= tail ? lower : none) = rank;
  }
  std::int64_t upper = n + 1;
  none = 0;
  while (upper - none > 1) {
    const std::int64_t rank = none + (upper - none) / 2;
    (binomial_upper_tail(rank, n, share) <= tail ? upper : none) = rank;
  }
  QuantileEstimate estimate;
  estimate.value = definition_8(sorted, share);
  const auto at = [&](std::int64_t rank) { return sorted[static_cast<std::size_t>(rank - 1)]; };
  estimate.interval = {lower < 1 ? -kInfinity : at(lower), upper > n ? kInfinity : at(upper)};
  return estimate;
}

}  // namespace dodgesim
