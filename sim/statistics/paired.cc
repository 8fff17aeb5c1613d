#include "sim/statistics/paired.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "sim/base/normal_distribution.h"
#include "sim/statistics/binomial.h"

namespace dodgesim {

namespace {

constexpr double kImplausible = 1e-6;  // see drop_p_value()

void check(const PairedCounts& counts) {
  if (std::min({counts.both, counts.only_first, counts.only_second, counts.neither}) < 0) {
    throw std::invalid_argument("Counts of throws must not be negative.");
  }
}

// Tango's statistic for `more` - `fewer` pairs of `total`, against a difference of the rates of
// `difference` (Tango 1998): standard normal under it; falls with `difference`.
double tango_statistic(std::int64_t more, std::int64_t fewer, std::int64_t total,
                       double difference) {
  const auto b = static_cast<double>(more), c = static_cast<double>(fewer);
  const auto n = static_cast<double>(total);
  // The rate of the `fewer` pairs that is most likely under the difference.
  const double linear = -b - c + (2 * n - b + c) * difference;
  const double constant = -c * difference * (1 - difference);
  const double root = std::sqrt(std::max(0.0, linear * linear - 8 * n * constant));
  const double rate = (root - linear) / (4 * n);
  const double excess = b - c - n * difference;
  const double variance = n * (2 * rate + difference * (1 - difference));
  if (variance <= 0) {
    return excess == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), excess);
  }
  return excess / std::sqrt(variance);
}

// Probability of all tables with b >= least[c] losses beside c gains, when a throw is lost with
// probability `lost` and gained with probability `gained`.
double probability_of_region(const std::vector<std::int64_t>& least, std::int64_t total,
                             double lost, double gained) {
  constexpr double kNegligible = 1e-16;
  const std::vector<double> gains = binomial_pmf_table(total, gained);
  const double lost_of_rest = std::min(1.0, lost / (1 - gained));
  double sum = 0;
  for (std::size_t c = 0; c < least.size(); ++c) {
    if (gains[c] < kNegligible) continue;
    const std::int64_t rest = total - static_cast<std::int64_t>(c);
    sum += gains[c] * binomial_upper_tail(least[c], rest, lost_of_rest);
  }
  return sum;
}

double one_sided(std::int64_t at_least, std::int64_t differing) {
  return binomial_upper_tail(at_least, differing, 0.5);
}

}  // namespace

double mcnemar(const PairedCounts& counts, Alternative alternative) {
  check(counts);
  const std::int64_t lost = counts.only_first, gained = counts.only_second;
  switch (alternative) {
    case Alternative::kLower:
      return one_sided(lost, lost + gained);
    case Alternative::kHigher:
      return one_sided(gained, lost + gained);
    case Alternative::kDifferent:
      break;
  }
  return std::min(1.0, 2 * one_sided(std::max(lost, gained), lost + gained));
}

Interval tango(const PairedCounts& counts, double confidence) {
  check(counts);
  check_confidence(confidence);
  if (counts.total() == 0) return {-1, 1};
  constexpr int kHalvings = 60;
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  // The largest difference at which the statistic is still above the bound.
  const auto difference_at = [&](double bound) {
    double lo = -1, hi = 1;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (lo + hi);
      const double statistic =
          tango_statistic(counts.only_second, counts.only_first, counts.total(), middle);
      (statistic > bound ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
  };
  return {difference_at(z), difference_at(-z)};
}

Interval bonett_price(const PairedCounts& counts, double confidence) {
  check(counts);
  check_confidence(confidence);
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const std::int64_t n = counts.both + counts.only_first + counts.only_second;  // with a success
  if (n == 0) return {0, kInfinite};
  const std::int64_t first = counts.both + counts.only_first;
  const std::int64_t second = counts.both + counts.only_second;
  const auto error = [n](std::int64_t successes) {
    const auto more = static_cast<double>(successes + 1);
    return std::sqrt((1 - more / static_cast<double>(n + 2)) / more);
  };
  // Narrower than each rate's own interval, as the two rates are of the same throws.
  const double z = normal_quantile(0.5 + 0.5 * confidence) *
                   std::sqrt(static_cast<double>(counts.only_first + counts.only_second + 2) /
                             (static_cast<double>(first + 1) * static_cast<double>(second + 1))) /
                   (error(first) + error(second));
  const Interval of_first = wilson_of_quantile(first, n, z);
  const Interval of_second = wilson_of_quantile(second, n, z);
  return {of_second.lo / of_first.hi, of_first.lo > 0 ? of_second.hi / of_first.lo : kInfinite};
}

double drop_p_value(const PairedCounts& counts, double margin) {
  check(counts);
  if (!(margin > -1 && margin < 1)) {
    throw std::invalid_argument("A margin of rates must lie between -1 and 1, both excluded.");
  }
  const std::int64_t n = counts.total();
  if (n == 0) return 1;
  constexpr double kTie = 1e-9;  // statistics that are equal but for rounding
  const double seen = tango_statistic(counts.only_first, counts.only_second, n, margin) - kTie;
  // least[c]: the fewest losses that are as extreme beside c gains; it rises with c.
  std::vector<std::int64_t> least(static_cast<std::size_t>(n + 1));
  std::int64_t b = 0;
  for (std::int64_t c = 0; c <= n; ++c) {
    while (b <= n - c && tango_statistic(b, c, n, margin) < seen) ++b;
    least[static_cast<std::size_t>(c)] = b;
  }
  // At the border of the null, lost - gained = margin, the smaller of the two rates is free. The
  // search stays where the count seen does not refute it.
  const double least_lost = std::max(0.0, margin), least_gained = std::max(0.0, -margin);
  const Interval plausible =
      clopper_pearson(margin < 0 ? counts.only_first : counts.only_second, n, 1 - kImplausible);
  const double end = 0.5 * (1 - std::abs(margin));
  const double largest = largest_p_value(
      std::min(plausible.lo, end), std::min(plausible.hi, end),
      [&](double q) { return probability_of_region(least, n, least_lost + q, least_gained + q); });
  return std::min(1.0, largest + kImplausible);
}

DropVerdict judge_drop(const PairedCounts& counts, double margin, double confidence) {
  check(counts);
  check_confidence(confidence);
  if (!(margin >= 0 && margin < 1)) {
    throw std::invalid_argument("The margin of a drop must lie between 0 and 1, 1 excluded.");
  }
  DropVerdict verdict;
  if (counts.total() == 0) return verdict;
  verdict.drop = static_cast<double>(counts.only_first - counts.only_second) /
                 static_cast<double>(counts.total());
  verdict.p_fell = drop_p_value(counts, margin);
  // A fall by the margin or more is a rise by at most -margin, seen from the other side.
  const PairedCounts swapped{counts.both, counts.only_second, counts.only_first, counts.neither};
  verdict.p_kept = drop_p_value(swapped, -margin);
  verdict.fell = verdict.p_fell <= 1 - confidence;
  verdict.kept = verdict.p_kept <= 1 - confidence;
  return verdict;
}

}  // namespace dodgesim
