#include "sim/statistics/binomial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dodgesim {

namespace {

// log(n!) less Stirling's formula, log(sqrt(2 pi n) (n/e)^n).
double stirling_error(std::int64_t count) {
  constexpr std::int64_t kSeriesFrom = 16;
  const auto n = static_cast<double>(count);
  if (count == 0) return 0;
  if (count < kSeriesFrom) {
    double factorial = 1;
    for (std::int64_t i = 2; i <= count; ++i) factorial *= static_cast<double>(i);
    return std::log(factorial) - 0.5 * std::log(2 * std::numbers::pi * n) - n * std::log(n) + n;
  }
  const double nn = n * n;
  return (1.0 / 12 - (1.0 / 360 - (1.0 / 1260 - (1.0 / 1680 - 1.0 / 1188 / nn) / nn) / nn) / nn) /
         n;
}

// x log(x / mean) + mean - x, without cancellation where x is near the mean (Loader's bd0).
double deviance(double x, double mean) {
  constexpr double kSeriesBelow = 0.1;
  if (std::abs(x - mean) >= kSeriesBelow * (x + mean)) return x * std::log(x / mean) + mean - x;
  const double v = (x - mean) / (x + mean);
  double sum = (x - mean) * v;
  double term = 2 * x * v;
  for (int j = 3;; j += 2) {
    term *= v * v;
    const double next = sum + term / j;
    if (next == sum) return sum;
    sum = next;
  }
}

double tail_downwards(std::int64_t k, std::int64_t n, double p) {
  double term = binomial_pmf(k, n, p);
  double sum = term;
  for (std::int64_t i = k; i > 0 && term > kNegligibleTerm * sum; --i) {
    term *= static_cast<double>(i) * (1 - p) / (static_cast<double>(n - i + 1) * p);
    sum += term;
  }
  return std::min(sum, 1.0);
}

double tail_upwards(std::int64_t k, std::int64_t n, double p) {
  double term = binomial_pmf(k, n, p);
  double sum = term;
  for (std::int64_t i = k; i < n && term > kNegligibleTerm * sum; ++i) {
    term *= static_cast<double>(n - i) * p / (static_cast<double>(i + 1) * (1 - p));
    sum += term;
  }
  return std::min(sum, 1.0);
}

}  // namespace

double log_binomial_pmf(std::int64_t k, std::int64_t n, double p) {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  if (k < 0 || k > n) return kNever;
  const auto trials = static_cast<double>(n), x = static_cast<double>(k);
  if (p <= 0) return k == 0 ? 0 : kNever;
  if (p >= 1) return k == n ? 0 : kNever;
  if (k == 0) return trials * std::log1p(-p);
  if (k == n) return trials * std::log(p);
  const double rest = trials - x;
  return stirling_error(n) - stirling_error(k) - stirling_error(n - k) - deviance(x, trials * p) -
         deviance(rest, trials * (1 - p)) +
         0.5 * std::log(trials / (2 * std::numbers::pi * x * rest));
}

double binomial_pmf(std::int64_t k, std::int64_t n, double p) {
  return std::exp(log_binomial_pmf(k, n, p));
}

double binomial_lower_tail(std::int64_t k, std::int64_t n, double p) {
  if (k < 0) return 0;
  if (k >= n || p <= 0) return 1;
  if (p >= 1) return 0;
  if (static_cast<double>(k) > static_cast<double>(n) * p) return 1 - tail_upwards(k + 1, n, p);
  return tail_downwards(k, n, p);
}

double binomial_upper_tail(std::int64_t k, std::int64_t n, double p) {
  if (k > n) return 0;
  if (k <= 0 || p >= 1) return 1;
  if (p <= 0) return 0;
  if (static_cast<double>(k) < static_cast<double>(n) * p) return 1 - tail_downwards(k - 1, n, p);
  return tail_upwards(k, n, p);
}

std::vector<double> binomial_pmf_table(std::int64_t n, double p) {
  std::vector<double> table(static_cast<std::size_t>(n + 1), 0.0);
  const auto at = [&](std::int64_t k) -> double& { return table[static_cast<std::size_t>(k)]; };
  // From the mode outwards: the recurrence only shrinks.
  const std::int64_t mode = std::min(n, static_cast<std::int64_t>(static_cast<double>(n + 1) * p));
  at(mode) = binomial_pmf(mode, n, p);
  for (std::int64_t k = mode; k < n && at(k) > 0; ++k) {
    at(k + 1) = at(k) * static_cast<double>(n - k) * p / (static_cast<double>(k + 1) * (1 - p));
  }
  for (std::int64_t k = mode; k > 0 && at(k) > 0; --k) {
    at(k - 1) = at(k) * static_cast<double>(k) * (1 - p) / (static_cast<double>(n - k + 1) * p);
  }
  return table;
}

double hypergeometric_pmf(std::int64_t k, std::int64_t marked, std::int64_t unmarked,
                          std::int64_t drawn) {
  if (k < 0 || k > marked || drawn - k < 0 || drawn - k > unmarked) return 0;
  const std::int64_t all = marked + unmarked;
  if (all == 0) return 1;
  // Any p serves; this one keeps the three probabilities from underflow.
  const double p = static_cast<double>(drawn) / static_cast<double>(all);
  return std::exp(log_binomial_pmf(k, marked, p) + log_binomial_pmf(drawn - k, unmarked, p) -
                  log_binomial_pmf(drawn, all, p));
}

double largest_p_value(double lo, double hi, const std::function<double(double)>& p_value) {
  constexpr int kPoints = 300;
  constexpr int kRefinements = 40;
  const double step = 1.0 / kPoints;
  const auto at = [&](double t) {
    const double sine = std::sin(0.5 * std::numbers::pi * t);
    return p_value(lo + (hi - lo) * sine * sine);
  };
  double best = 0, best_t = 0;
  for (int i = 0; i <= kPoints; ++i) {
    const double value = at(i * step);
    if (value > best) {
      best = value;
      best_t = i * step;
    }
  }
  // Golden-section search between the neighbours.
  double from = std::max(0.0, best_t - step), to = std::min(1.0, best_t + step);
  for (int i = 0; i < kRefinements; ++i) {
    const double width = (to - from) / std::numbers::phi;
    const double left = to - width, right = from + width;
    const double at_left = at(left), at_right = at(right);
    best = std::max({best, at_left, at_right});
    (at_left < at_right ? from : to) = at_left < at_right ? left : right;
  }
  return std::min(best, 1.0);
}

}  // namespace dodgesim
