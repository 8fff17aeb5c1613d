#include "sim/statistics/unpaired.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/statistics/binomial.h"

namespace dodgesim {

namespace {

// Two p-values that are equal but for rounding count as a tie.
constexpr double kTie = 1 + 1e-7;

// Fisher's one-sided p-value (Fisher 1935): P(the first group has `least` successes or more | all
// successes of both).
double fisher_tail(std::int64_t least, std::int64_t n1, std::int64_t n2, std::int64_t successes) {
  const std::int64_t lowest = std::max<std::int64_t>(0, successes - n2);
  const std::int64_t highest = std::min(n1, successes);
  const double mean =
      static_cast<double>(successes) * static_cast<double>(n1) / static_cast<double>(n1 + n2);
  const bool above_mean = static_cast<double>(least) > mean;
  double sum = 0;
  std::int64_t k = above_mean ? least : least - 1;
  double term = hypergeometric_pmf(k, n1, n2, successes);
  while (term > kNegligibleTerm * sum) {
    sum += term;
    if (!above_mean) --k;
    const double rise = static_cast<double>(n1 - k) * static_cast<double>(successes - k) /
                        (static_cast<double>(k + 1) * static_cast<double>(n2 - successes + k + 1));
    if (k < lowest || k >= highest) break;
    term *= above_mean ? rise : 1 / rise;
    if (above_mean) ++k;
  }
  return std::clamp(above_mean ? sum : 1 - sum, 0.0, 1.0);
}

// Boschloo's p-value against "the second rate is lower".
double boschloo_lower(const Proportion& first, const Proportion& second) {
  const std::int64_t n1 = first.trials, n2 = second.trials;
  const double seen =
      fisher_tail(first.successes, n1, n2, first.successes + second.successes) * kTie;
  // most[x1]: the most successes of the second group with which x1 of the first are as extreme; it
  // rises with x1.
  std::vector<std::int64_t> most(static_cast<std::size_t>(n1 + 1));
  std::int64_t x2 = -1;
  for (std::int64_t x1 = 0; x1 <= n1; ++x1) {
    while (x2 < n2 && fisher_tail(x1, n1, n2, x1 + x2 + 1) <= seen) ++x2;
    most[static_cast<std::size_t>(x1)] = x2;
  }
  return largest_p_value(0, 1, [&](double rate) {
    const std::vector<double> p1 = binomial_pmf_table(n1, rate), p2 = binomial_pmf_table(n2, rate);
    double sum = 0, below = 0;
    std::int64_t k = -1;
    for (std::size_t x1 = 0; x1 < p1.size(); ++x1) {
      while (k < most[x1]) below += p2[static_cast<std::size_t>(++k)];
      sum += p1[x1] * below;
    }
    return sum;
  });
}

void check(const Proportion& first, const Proportion& second) {
  check_counts(first.successes, first.trials);
  check_counts(second.successes, second.trials);
}

}  // namespace

double boschloo(const Proportion& first, const Proportion& second, Alternative alternative) {
  check(first, second);
  switch (alternative) {
    case Alternative::kLower:
      return boschloo_lower(first, second);
    case Alternative::kHigher:
      return boschloo_lower(second, first);
    case Alternative::kDifferent:
      break;
  }
  return std::min(1.0, 2 * std::min(boschloo_lower(first, second), boschloo_lower(second, first)));
}

Interval newcombe(const Proportion& first, const Proportion& second, double confidence) {
  const Interval w1 = wilson(first.successes, first.trials, confidence);
  const Interval w2 = wilson(second.successes, second.trials, confidence);
  if (first.trials == 0 || second.trials == 0) return {-1, 1};
  const double p1 = static_cast<double>(first.successes) / static_cast<double>(first.trials);
  const double p2 = static_cast<double>(second.successes) / static_cast<double>(second.trials);
  return {p2 - p1 - std::hypot(p2 - w2.lo, w1.hi - p1),
          p2 - p1 + std::hypot(w2.hi - p2, p1 - w1.lo)};
}

}  // namespace dodgesim
