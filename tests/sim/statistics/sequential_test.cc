#include "sim/statistics/sequential.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/base/normal_distribution.h"
#include "sim/base/random.h"
#include "sim/statistics/binomial.h"

namespace dodgesim {
namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

struct Campaign {
  std::int64_t successes = 0, trials = 0;
};

Campaign run_until_done(const FixedWidthRule& rule, double rate, RandomStream& stream) {
  Campaign campaign;
  while (!rule.done(campaign.successes, campaign.trials)) {
    campaign.successes += stream.uniform() < rate;
    ++campaign.trials;
  }
  return campaign;
}

// The number of throws at which the campaign ends at the latest: an even outcome takes longest.
std::int64_t most_trials(const FixedWidthRule& rule) {
  std::int64_t trials = 1;
  while (!rule.done(trials / 2, trials)) ++trials;
  return trials;
}

// Of a campaign at a rate, exactly: how likely it goes on after n throws, for all n.
double expected_trials(const FixedWidthRule& rule, double rate) {
  std::vector<double> going_on = {1};  // by successes
  double expected = 0;
  for (std::int64_t n = 0; !going_on.empty(); ++n) {
    std::vector<double> next(static_cast<std::size_t>(n + 2), 0.0);
    bool ended = true;
    for (std::int64_t s = 0; s <= n; ++s) {
      if (rule.done(s, n)) continue;
      const auto i = static_cast<std::size_t>(s);
      expected += going_on[i];
      next[i] += going_on[i] * (1 - rate);
      next[i + 1] += going_on[i] * rate;
      ended = false;
    }
    going_on = ended ? std::vector<double>() : next;
  }
  return expected;
}

TEST(FixedWidthRule, StopsOnceTheHalfWidthIsReached) {
  const FixedWidthRule rule(0.03, 0.95, kNoLimit);
  // For some z, those counts are enough of which z sqrt(r (1 - r) / n) is small enough.
  double largest_enough = 0, smallest_not = 1;
  for (std::int64_t n = 1; n <= most_trials(rule); ++n) {
    for (std::int64_t s = 0; s <= n; ++s) {
      const double r = static_cast<double>(s + 4) / static_cast<double>(n + 8);
      const double deviation = std::sqrt(r * (1 - r) / static_cast<double>(n));
      if (rule.done(s, n)) {
        largest_enough = std::max(largest_enough, deviation);
        EXPECT_LE(rule.interval(s, n).half_width(), 0.03 + 1e-12);
      } else {
        smallest_not = std::min(smallest_not, deviation);
      }
    }
  }
  EXPECT_LT(largest_enough, smallest_not);
  EXPECT_NEAR(0.03 / largest_enough, 2.04, 0.01);  // z: that of a fixed plan is 1.96
}

TEST(FixedWidthRule, ReportsTheObservedRateWithItsHalfWidth) {
  const FixedWidthRule rule(0.05, 0.95, kNoLimit);
  const Interval middle = rule.interval(300, 600);
  EXPECT_NEAR(middle.lo, 0.45, 1e-12);
  EXPECT_NEAR(middle.hi, 0.55, 1e-12);
  EXPECT_EQ(rule.interval(0, 200).lo, 0);
  EXPECT_NEAR(rule.interval(0, 200).hi, 0.05, 1e-12);
  EXPECT_EQ(rule.interval(200, 200).hi, 1);
  EXPECT_EQ(rule.interval(0, 0).lo, 0);
  EXPECT_EQ(rule.interval(0, 0).hi, 1);
  EXPECT_FALSE(rule.done(0, 0));
}

// Every rate, by counting paths: on a grid of its own and at the rule's own worst rates.
TEST(FixedWidthRule, CoversEveryRate) {
  for (const double confidence : {0.8, 0.95, 0.99}) {
    for (const double half_width : {0.5, 0.2, 0.07, 0.03}) {
      const FixedWidthRule rule(half_width, confidence, kNoLimit);
      EXPECT_GE(rule.least_coverage(), confidence) << half_width;
      double least = 1;
      for (int i = 0; i <= 4000; ++i) least = std::min(least, rule.coverage(i / 4000.0));
      EXPECT_GE(least, rule.least_coverage() - 1e-12) << half_width << " " << confidence;
      // And without waste, once throws are so many that one more matters little.
      EXPECT_LT(rule.least_coverage(), confidence + 0.2 * half_width);
    }
  }
}

TEST(FixedWidthRule, CoversEveryRateWhenTheThrowsRunOut) {
  for (const std::int64_t most : {1, 7, 60, 400}) {
    const FixedWidthRule rule(0.05, 0.95, most);
    EXPECT_TRUE(rule.done(most / 2, most));
    for (int i = 0; i <= 1000; ++i) EXPECT_GE(rule.coverage(i / 1000.0), 0.95) << most << " " << i;
  }
}

TEST(FixedWidthRule, WidensItsIntervalWhenTheThrowsRunOut) {
  const FixedWidthRule rule(0.05, 0.95, 60);
  EXPECT_GT(rule.interval(30, 60).half_width(), 0.12);
  // Pooled with the pseudo counts, 30 of 60 is 1/2 and 13 of 60 is 1/4.
  EXPECT_NEAR(rule.interval(13, 60).half_width() / rule.interval(30, 60).half_width(),
              std::sqrt(0.25 * 0.75) / 0.5, 1e-12);
}

// The throws planned are 60, of which fewer were trials: the campaign stopped, or went on, by the
// rule of 60.
TEST(FixedWidthRule, CoversEveryRateWhenThrowsWereNoTrials) {
  for (const std::int64_t planned : {60, 400}) {
    const FixedWidthRule rule(0.05, 0.95, planned);
    for (const std::int64_t trials : {1, 2, 7, 20, 58, 60, 150, 300}) {
      if (trials > planned) continue;
      const FixedWidthRule shorter = rule.run_out(trials);
      for (std::int64_t n = 1; n < trials; ++n) {
        for (std::int64_t s = 0; s <= n; ++s) EXPECT_EQ(shorter.done(s, n), rule.done(s, n));
      }
      EXPECT_TRUE(shorter.done(trials / 2, trials));
      double least = 1;
      for (int i = 0; i <= 1000; ++i) least = std::min(least, shorter.coverage(i / 1000.0));
      EXPECT_GE(least, 0.95) << planned << " " << trials;
    }
  }
  const FixedWidthRule rule(0.05, 0.95, 60);
  EXPECT_NEAR(rule.run_out(58).interval(34, 58).half_width(), 0.13, 0.01);
  EXPECT_EQ(most_trials(rule.run_out(100)), 60);
  EXPECT_THROW(static_cast<void>(rule.run_out(0)), std::invalid_argument);
}

// All paths end somewhere: at rates whose intervals all hold, the probabilities of the stop points
// add up to 1.
TEST(FixedWidthRule, CountsAllPaths) {
  const FixedWidthRule rule(0.5, 0.95, 3);
  // Three throws at most, none of which ends the campaign before.
  ASSERT_FALSE(rule.done(0, 2));
  EXPECT_NEAR(expected_trials(rule, 0.37), 3, 1e-12);
  EXPECT_NEAR(rule.coverage(0.5), 1, 1e-12);
  const FixedWidthRule longer(0.1, 0.95, kNoLimit);
  EXPECT_NEAR(longer.coverage(0), 1, 1e-12);
  EXPECT_NEAR(longer.coverage(1), 1, 1e-12);
}

TEST(FixedWidthRule, SimulatedCampaignsCoverAndLastAsComputed) {
  const FixedWidthRule rule(0.06, 0.95, kNoLimit);
  RandomStream stream(2, 0, "sequential test");
  constexpr int kCampaigns = 3000;
  for (const double rate : {0.02, 0.1, 0.25, 0.4, 0.5, 0.65, 0.8, 0.95, 0.98}) {
    int covered = 0;
    double trials = 0, squares = 0;
    for (int i = 0; i < kCampaigns; ++i) {
      const Campaign campaign = run_until_done(rule, rate, stream);
      covered += rule.interval(campaign.successes, campaign.trials).contains(rate);
      const auto n = static_cast<double>(campaign.trials);
      trials += n / kCampaigns;
      squares += n * n / kCampaigns;
    }
    const double expected = rule.coverage(rate);
    const double sigma = std::sqrt(expected * (1 - expected) / kCampaigns);
    EXPECT_GE(expected, 0.95);
    EXPECT_NEAR(static_cast<double>(covered) / kCampaigns, expected, 4 * sigma) << rate;
    const double trials_sigma = std::sqrt(std::max(0.0, squares - trials * trials) / kCampaigns);
    EXPECT_NEAR(trials, expected_trials(rule, rate), 4 * trials_sigma + 1e-9) << rate;
  }
}

// The price that the header states.
TEST(FixedWidthRule, CostsLittleMoreThanAFixedNumberOfThrows) {
  const FixedWidthRule rule(0.03, 0.95, kNoLimit);
  const double z = normal_quantile(0.975);
  const auto fixed = [&](double rate) { return z * z * rate * (1 - rate) / (0.03 * 0.03); };
  EXPECT_EQ(most_trials(rule), 1156);
  EXPECT_LT(static_cast<double>(most_trials(rule)) / fixed(0.5), 1.09);
  EXPECT_NEAR(expected_trials(rule, 0.9), 437, 0.5);
  EXPECT_LT(expected_trials(rule, 0.9) / fixed(0.9), 1.15);
  EXPECT_LT(expected_trials(rule, 0.9) / fixed(0.5), 0.42);
}

TEST(FixedWidthRule, RefusesImpossibleDemands) {
  EXPECT_THROW(FixedWidthRule(0.004, 0.95, 100), std::invalid_argument);
  EXPECT_THROW(FixedWidthRule(0.51, 0.95, 100), std::invalid_argument);
  EXPECT_THROW(FixedWidthRule(NAN, 0.95, 100), std::invalid_argument);
  EXPECT_THROW(FixedWidthRule(0.1, 1, 100), std::invalid_argument);
  EXPECT_THROW(FixedWidthRule(0.1, 0.95, 0), std::invalid_argument);
  EXPECT_THROW(FixedWidthRule(0.1, 0.95, 100).done(3, 2), std::invalid_argument);
}

// Probability that the interval excluded the rate at one throw or more up to `horizon`.
double ever_missed(const std::vector<std::vector<Interval>>& intervals, double rate) {
  std::vector<double> alive = {1};  // by successes; never missed so far
  double missed = 0;
  for (std::size_t n = 1; n < intervals.size(); ++n) {
    std::vector<double> next(n + 1, 0.0);
    for (std::size_t s = 0; s < n; ++s) {
      next[s] += alive[s] * (1 - rate);
      next[s + 1] += alive[s] * rate;
    }
    for (std::size_t s = 0; s <= n; ++s) {
      if (intervals[n][s].contains(rate)) continue;
      missed += next[s];
      next[s] = 0;
    }
    alive = next;
  }
  return missed;
}

std::vector<std::vector<Interval>> all_intervals(Interval (*method)(std::int64_t, std::int64_t,
                                                                    double),
                                                 std::int64_t horizon, double confidence) {
  std::vector<std::vector<Interval>> intervals(static_cast<std::size_t>(horizon + 1));
  for (std::int64_t n = 0; n <= horizon; ++n) {
    for (std::int64_t s = 0; s <= n; ++s) {
      intervals[static_cast<std::size_t>(n)].push_back(method(s, n, confidence));
    }
  }
  return intervals;
}

TEST(ConfidenceSequence, HoldsAtAllThrowsAtOnceWhereWilsonsIntervalDoesNot) {
  constexpr std::int64_t kHorizon = 300;
  const auto sequence = all_intervals(confidence_sequence, kHorizon, 0.9);
  const auto usual = all_intervals(wilson, kHorizon, 0.9);
  double most_missed = 0;
  for (const double rate : {0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98}) {
    const double missed = ever_missed(sequence, rate);
    EXPECT_LE(missed, 0.1) << rate;
    EXPECT_GT(ever_missed(usual, rate), 0.25) << rate;
    most_missed = std::max(most_missed, missed);
  }
  RecordProperty("most_missed", std::to_string(most_missed));
  EXPECT_GT(most_missed, 0.02);  // it is not just wide
}

// Robbins 1970: (n + 1) times the probability of the count is 1 - confidence at the bounds.
TEST(ConfidenceSequence, EndsWhereTheMixtureSaysSo) {
  const Interval interval = confidence_sequence(40, 100);
  EXPECT_LT(interval.lo, 0.4);
  EXPECT_GT(interval.hi, 0.4);
  EXPECT_NEAR(101 * binomial_pmf(40, 100, interval.lo), 0.05, 1e-9);
  EXPECT_NEAR(101 * binomial_pmf(40, 100, interval.hi), 0.05, 1e-9);
  // Nothing succeeded: (n + 1) (1 - p)^n = 0.05.
  EXPECT_EQ(confidence_sequence(0, 100).lo, 0);
  EXPECT_NEAR(confidence_sequence(0, 100).hi, 1 - std::pow(0.05 / 101, 0.01), 1e-12);
  EXPECT_NEAR(confidence_sequence(30, 100).lo, 1 - confidence_sequence(70, 100).hi, 1e-12);
}

TEST(ConfidenceSequence, ContainsWilsonsIntervalAndNarrows) {
  EXPECT_EQ(confidence_sequence(0, 0).lo, 0);
  EXPECT_EQ(confidence_sequence(0, 0).hi, 1);
  double previous = 1;
  for (const std::int64_t n : {10, 100, 1000, 100'000, 10'000'000}) {
    const Interval sequence = confidence_sequence(n / 5, n), usual = wilson(n / 5, n);
    EXPECT_LT(sequence.lo, usual.lo);
    EXPECT_GT(sequence.hi, usual.hi);
    EXPECT_LT(sequence.half_width(), previous);
    previous = sequence.half_width();
  }
  EXPECT_THROW(confidence_sequence(2, 1), std::invalid_argument);
  EXPECT_THROW(confidence_sequence(1, 2, 0), std::invalid_argument);
}

TEST(ConfidenceSequence, CostsWhatTheHeaderStates) {
  std::int64_t n = 2;
  while (confidence_sequence(n / 2, n).half_width() > 0.03) n += 2;
  EXPECT_NEAR(static_cast<double>(n) / 1067, 3.6, 0.05);
}

}  // namespace
}  // namespace dodgesim
