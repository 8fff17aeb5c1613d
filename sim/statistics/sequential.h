// Stopping a campaign when its success rate is known well enough, without spoiling the interval.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/statistics/interval.h"

namespace dodgesim {

// Stops as soon as the success rate is known to +- half_width: `stop: {half_width: 0.03}`.
//
// Looking at a usual interval after each throw and stopping when it is narrow enough covers too
// seldom (Wilson's at 95 % and 0.05: 93.3 % at the worst rate). This is a fixed-width rule after
// Frey 2010 (The American Statistician 64:242) with pseudo counts of 4: stop at the first n with z
// sqrt(r (1 - r) / n) <= half_width, where r = (successes + 4) / (n + 8), and report successes / n
// +- half_width. The constructor chooses z such that the coverage is at least the confidence at
// every rate: it counts the paths to each stopping point exactly. The price is small: at confidence
// 0.95 and half_width 0.03 it takes 1156 throws at most, where a fixed plan for an unknown rate
// takes 1068; at a rate of 0.9 it takes 437 on average, where a plan that knew the rate would take
// 385.
//
// Throws must be added in the order of their index, whatever the order in which workers finish.
class FixedWidthRule {
 public:
  static constexpr double kLeastHalfWidth = 0.005;
  static constexpr double kMostHalfWidth = 0.5;

  // `max_trials`: the number of throws at which the campaign ends in any case (the interval is then
  // wider than asked for, and covers all the same). Throws std::invalid_argument when half_width
  // lies outside of [kLeastHalfWidth, kMostHalfWidth] or max_trials < 1. Takes 20 ms for a
  // half_width of 0.03, a second for 0.01.
  FixedWidthRule(double half_width, double confidence, std::int64_t max_trials);

  // Whether the campaign ends with these counts.
  bool done(std::int64_t successes, std::int64_t trials) const;

  // The same rule for a campaign whose throws have run out after fewer trials than max_trials,
  // because some throws were no trials (a ball that would have missed). It stops as this rule does,
  // but at `trials` in any case, and its interval there is as wide as the coverage needs: which
  // throws are trials must not depend on their success. Throws std::invalid_argument when
  // trials < 1.
  FixedWidthRule run_out(std::int64_t trials) const;

  // Holds with the confidence at the counts with which done() first became true, and is no
  // statement before: use confidence_sequence() for a look at a campaign under way.
  Interval interval(std::int64_t successes, std::int64_t trials) const;

  // Exact, of a true rate of p in [0, 1], and the smallest of all p.
  double coverage(double p) const;
  double least_coverage() const;

 private:
  // Counts at which the campaign may end.
  struct StopPoint {
    std::int64_t successes;
    std::int64_t trials;
    double log_paths;  // logarithm of the number of ways to arrive there
    Interval interval;

    double probability(double p) const;
  };

  // Sets a z with set(z) whose coverage is good enough, not much larger than the least: between
  // `too_small` and `enough`, or beyond.
  template <class Set>
  void choose_z(double too_small, double enough, Set set);
  void set_z(double z);
  bool covers_every_rate() const;
  // Visits rates, the least covered among them, until visit(rate) is false.
  template <class Visit>
  void visit_least_covered(Visit visit) const;
  bool narrow(std::int64_t successes, std::int64_t trials) const;
  void find_stop_points();

  double half_width_, confidence_;
  std::int64_t asked_max_trials_;
  double z_ = 0;       // of the stop
  double last_z_ = 0;  // of the interval where the throws run out
  std::int64_t max_trials_ = 0;
  std::vector<StopPoint> stop_points_;  // by the rising middle of their intervals
  double widest_ = 0;                   // half width of all intervals
};

// Interval of a rate that holds at all times at once: whoever looks after each throw and stops when
// and why he likes covers the rate with the confidence. Confidence sequence of Robbins 1970 (Annals
// of Mathematical Statistics 41:1397; a mixture of likelihood ratios over a uniform rate, with
// Ville's inequality): all p with (n + 1) P(Bin(n, p) = successes) > 1 - confidence. The price of
// that freedom: at a half width of 0.03, about 3.6 times the throws of a fixed plan.
Interval confidence_sequence(std::int64_t successes, std::int64_t trials, double confidence = 0.95);

}  // namespace dodgesim
