#include "sim/statistics/sequential.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sim/base/normal_distribution.h"
#include "sim/statistics/binomial.h"

namespace dodgesim {

namespace {

constexpr std::int64_t kPseudoCounts = 4;  // of either outcome: keeps an early streak from stopping

constexpr double kGrowth = 1.1;  // of z, until the coverage is good

constexpr double kBeside = 1e-11;  // a rate beside another: more than rounding

// Standard deviation of one outcome, as estimated with the pseudo counts.
double outcome_sd(std::int64_t successes, std::int64_t trials) {
  const double rate = static_cast<double>(successes + kPseudoCounts) /
                      static_cast<double>(trials + 2 * kPseudoCounts);
  return std::sqrt(rate * (1 - rate));
}

// The shares of the orders of [first, last] successes in n throws, from those of [first, last - 1]
// in n - 1. Counts are int, which any processor turns into several doubles at once.
void add_throw(int n, int first, int last, const double* before, double* share) {
  share[first] = before[first] * (n - first) / n;
  for (int s = first + 1; s < last; ++s) {
    share[s] = (before[s - 1] * s + before[s] * (n - s)) / n;
  }
  share[last] = before[last - 1] * last / n;
}

}  // namespace

FixedWidthRule::FixedWidthRule(double half_width, double confidence, std::int64_t max_trials)
    : half_width_(half_width), confidence_(confidence), asked_max_trials_(max_trials) {
  check_confidence(confidence);
  if (!(half_width >= kLeastHalfWidth && half_width <= kMostHalfWidth)) {
    throw std::invalid_argument("The half width of a stopping rule must lie in [0.005, 0.5].");
  }
  if (max_trials < 1) throw std::invalid_argument("A stopping rule needs at least one throw.");
  const double nominal = normal_quantile(0.5 + 0.5 * confidence);
  choose_z(nominal / kGrowth, nominal, [this](double z) { set_z(z); });
}

FixedWidthRule FixedWidthRule::run_out(std::int64_t trials) const {
  if (trials < 1) throw std::invalid_argument("A stopping rule needs at least one throw.");
  FixedWidthRule rule = *this;
  if (trials >= max_trials_) return rule;
  rule.max_trials_ = trials;
  rule.find_stop_points();
  if (rule.covers_every_rate()) return rule;
  // Campaigns that stop before miss the rate no more often than this rule's: some z is enough.
  rule.choose_z(z_, z_ * kGrowth, [&rule](double z) {
    rule.last_z_ = z;
    rule.find_stop_points();
  });
  return rule;
}

template <class Set>
void FixedWidthRule::choose_z(double too_small, double enough, Set set) {
  constexpr int kHalvings = 8;
  // Coverage need not rise steadily with z: `enough` always is a z whose coverage was found good.
  const auto covers = [&](double z) {
    set(z);
    return covers_every_rate();
  };
  while (!covers(enough)) {
    too_small = enough;
    enough *= kGrowth;
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double z = 0.5 * (too_small + enough);
    (covers(z) ? enough : too_small) = z;
  }
  set(enough);
}

bool FixedWidthRule::narrow(std::int64_t successes, std::int64_t trials) const {
  return z_ * outcome_sd(successes, trials) <= half_width_ * std::sqrt(static_cast<double>(trials));
}

bool FixedWidthRule::done(std::int64_t successes, std::int64_t trials) const {
  check_counts(successes, trials);
  return trials > 0 && (trials >= max_trials_ || narrow(successes, trials));
}

Interval FixedWidthRule::interval(std::int64_t successes, std::int64_t trials) const {
  check_counts(successes, trials);
  if (trials == 0) return {0, 1};
  const auto n = static_cast<double>(trials);
  const double rate = static_cast<double>(successes) / n;
  const double half = narrow(successes, trials)
                          ? half_width_
                          : last_z_ * outcome_sd(successes, trials) / std::sqrt(n);
  return {std::max(0.0, rate - half), std::min(1.0, rate + half)};
}

void FixedWidthRule::set_z(double z) {
  z_ = last_z_ = z;
  // At this number of throws the largest deviation, 0.5, is known well enough.
  const double enough = std::ceil(std::pow(0.5 * z / half_width_, 2));
  max_trials_ = std::min(asked_max_trials_, static_cast<std::int64_t>(std::max(1.0, enough)));
  find_stop_points();
}

// share[s]: of all orders of s successes in n throws, the share in which no earlier throw ended the
// campaign. It follows from the shares at n - 1 by the last throw's outcome.
void FixedWidthRule::find_stop_points() {
  stop_points_.clear();
  std::vector<double> share(static_cast<std::size_t>(max_trials_ + 1), 0.0), before = share;
  share[0] = 1;
  std::int64_t first = 0, last = 0;  // the counts at which the campaign goes on
  for (std::int64_t n = 1; n <= max_trials_ && first <= last; ++n) {
    std::swap(share, before);
    ++last;
    add_throw(static_cast<int>(n), static_cast<int>(first), static_cast<int>(last), before.data(),
              share.data());
    const auto stop_at = [&](std::int64_t s) {
      if (!done(s, n)) return false;
      const double log_orders =
          log_binomial_pmf(s, n, 0.5) + static_cast<double>(n) * std::numbers::ln2;
      stop_points_.push_back(
          {s, n, log_orders + std::log(share[static_cast<std::size_t>(s)]), interval(s, n)});
      return true;
    };
    // The spread is largest in the middle: the campaign ends from the outside inwards.
    while (first <= last && stop_at(first)) ++first;
    while (first <= last && stop_at(last)) --last;
  }
  std::ranges::sort(stop_points_, [](const StopPoint& a, const StopPoint& b) {
    return a.interval.middle() < b.interval.middle();
  });
  widest_ = 0;
  for (const StopPoint& point : stop_points_) {
    widest_ = std::max(widest_, point.interval.half_width());
  }
}

double FixedWidthRule::StopPoint::probability(double p) const {
  const auto s = static_cast<double>(successes), f = static_cast<double>(trials - successes);
  const double success = successes == 0 ? 0 : s * std::log(p);
  const double failure = trials == successes ? 0 : f * std::log1p(-p);
  return std::exp(log_paths + success + failure);
}

double FixedWidthRule::coverage(double p) const {
  // Only intervals whose middle is near enough can contain p.
  const auto first = std::partition_point(
      stop_points_.begin(), stop_points_.end(),
      [&](const StopPoint& point) { return point.interval.middle() < p - widest_ - kBeside; });
  double sum = 0;
  for (auto point = first; point != stop_points_.end(); ++point) {
    if (point->interval.middle() > p + widest_ + kBeside) break;
    if (point->interval.contains(p)) sum += point->probability(p);
  }
  return sum;
}

// Between two neighbouring ends of intervals the stop points that cover are the same, those between
// two counts, and their probability rises and falls once: it is smallest next to an end.
template <class Visit>
void FixedWidthRule::visit_least_covered(Visit visit) const {
  for (const StopPoint& point : stop_points_) {
    for (const double p : {point.interval.lo - kBeside, point.interval.hi + kBeside}) {
      if (p > 0 && p <= 0.5 && !visit(p)) return;  // the rule is symmetric
    }
  }
}

double FixedWidthRule::least_coverage() const {
  double least = 1;
  visit_least_covered([&](double p) {
    least = std::min(least, coverage(p));
    return true;
  });
  return least;
}

bool FixedWidthRule::covers_every_rate() const {
  bool covers = true;
  visit_least_covered([&](double p) { return covers = coverage(p) >= confidence_; });
  return covers;
}

Interval confidence_sequence(std::int64_t successes, std::int64_t trials, double confidence) {
  check_counts(successes, trials);
  check_confidence(confidence);
  if (trials == 0) return {0, 1};
  constexpr int kHalvings = 60;
  const double bound = std::log(1 - confidence) - std::log(static_cast<double>(trials + 1));
  const double rate = static_cast<double>(successes) / static_cast<double>(trials);
  // The probability falls on both sides of the observed rate.
  const auto bound_towards = [&](double outside) {
    double inside = rate;
    for (int i = 0; i < kHalvings; ++i) {
      const double p = 0.5 * (inside + outside);
      (log_binomial_pmf(successes, trials, p) > bound ? inside : outside) = p;
    }
    return outside;
  };
  return {successes == 0 ? 0 : bound_towards(0), successes == trials ? 1 : bound_towards(1)};
}

}  // namespace dodgesim
