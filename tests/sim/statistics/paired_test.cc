#include "sim/statistics/paired.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/statistics/binomial.h"

namespace dodgesim {
namespace {

using enum Alternative;

// Tables of published examples, in the order of PairedCounts.
constexpr PairedCounts kBentur{1, 1, 7, 12};      // airway hyper-responsiveness, 2009
constexpr PairedCounts kCavo{59, 6, 16, 80};      // complete response, 2012
constexpr PairedCounts kArmitage{20, 12, 2, 16};  // two culture media, 1994

TEST(PairedCounts, CountsThrowsByOutcome) {
  PairedCounts counts;
  for (const auto& [first, second] : {std::pair{true, true},
                                      {true, false},
                                      {true, false},
                                      {false, true},
                                      {false, false},
                                      {true, false}}) {
    counts.add(first, second);
  }
  EXPECT_EQ(counts.both, 1);
  EXPECT_EQ(counts.only_first, 3);
  EXPECT_EQ(counts.only_second, 1);
  EXPECT_EQ(counts.neither, 1);
  EXPECT_EQ(counts.total(), 6);
}

// Fagerland, Lydersen and Laake 2013, tables 1 and 2; Armitage and Berry 1994, p. 127.
TEST(McNemar, AgreesWithPublishedPValues) {
  EXPECT_NEAR(mcnemar(kBentur), 0.0703, 5e-5);
  EXPECT_NEAR(mcnemar(kCavo), 0.0525, 5e-5);
  EXPECT_NEAR(mcnemar(kArmitage), 0.0129, 5e-5);
}

TEST(McNemar, IsASignTestOfTheThrowsThatDiffer) {
  // Of 5 throws that differ 4 were lost: (5 + 1) / 2^5.
  EXPECT_NEAR(mcnemar({90, 4, 1, 5}, kLower), 6.0 / 32, 1e-15);
  EXPECT_NEAR(mcnemar({90, 4, 1, 5}, kHigher), 31.0 / 32, 1e-15);
  EXPECT_NEAR(mcnemar({90, 4, 1, 5}), 12.0 / 32, 1e-15);
  EXPECT_EQ(mcnemar({0, 2, 2, 0}), 1);
}

TEST(McNemar, IgnoresThrowsThatAgreeAndMirrors) {
  EXPECT_EQ(mcnemar({0, 9, 3, 0}, kLower), mcnemar({500, 9, 3, 70}, kLower));
  EXPECT_EQ(mcnemar({0, 9, 3, 0}, kLower), mcnemar({0, 3, 9, 0}, kHigher));
  EXPECT_EQ(mcnemar({0, 9, 3, 0}, kDifferent), mcnemar({0, 3, 9, 0}, kDifferent));
  EXPECT_EQ(mcnemar({8, 0, 0, 4}, kDifferent), 1);
  EXPECT_EQ(mcnemar({8, 0, 0, 4}, kLower), 1);
  EXPECT_LT(mcnemar({0, 10, 3, 0}, kLower), mcnemar({0, 9, 3, 0}, kLower));
  EXPECT_THROW(mcnemar({0, -1, 3, 0}, kLower), std::invalid_argument);
}

// Tango 1998 (the first two), Agresti and Min 2005, Fagerland et al. 2014, Chang et al. 2024, Tang
// et al. 2010. Our difference is second - first.
TEST(Tango, AgreesWithPublishedIntervals) {
  const struct {
    PairedCounts counts;
    double confidence, lo, hi, rounding;
  } published[] = {
      {{4, 9, 3, 16}, 0.95, -0.390, 0.027, 5e-4},      {{43, 0, 1, 0}, 0.90, -0.037, 0.096, 5.5e-4},
      {{53, 16, 8, 9}, 0.95, -0.207, 0.020, 5e-4},     {kBentur, 0.95, 0.026, 0.517, 5e-4},
      {{7, 25, 2, 68}, 0.95, -0.321, -0.139, 5e-4},    {{8, 3, 1, 2}, 0.95, -0.4327, 0.1670, 5e-5},
      {{565, 25, 28, 0}, 0.90, -0.0148, 0.0247, 5e-5},
  };
  for (const auto& [counts, confidence, lo, hi, rounding] : published) {
    const Interval interval = tango(counts, confidence);
    EXPECT_NEAR(interval.lo, lo, rounding) << counts.only_first << " " << counts.only_second;
    EXPECT_NEAR(interval.hi, hi, rounding) << counts.only_first << " " << counts.only_second;
  }
}

TEST(Tango, MirrorsAndStaysWithinItsRange) {
  for (const PairedCounts& counts : {kBentur, kCavo, PairedCounts{0, 30, 0, 0},
                                     PairedCounts{0, 0, 30, 0}, PairedCounts{53, 0, 0, 1}}) {
    const Interval interval = tango(counts);
    const Interval mirrored =
        tango({counts.both, counts.only_second, counts.only_first, counts.neither});
    EXPECT_NEAR(interval.lo, -mirrored.hi, 1e-12);
    EXPECT_GE(interval.lo, -1);
    EXPECT_LE(interval.hi, 1);
    const double seen = static_cast<double>(counts.only_second - counts.only_first) /
                        static_cast<double>(counts.total());
    EXPECT_TRUE(interval.contains(seen));
    EXPECT_GT(tango(counts, 0.99).half_width(), interval.half_width());
  }
  EXPECT_EQ(tango({}).lo, -1);
  EXPECT_EQ(tango({}).hi, 1);
}

// Without losses and gains, the bounds are those of a rate of n throws none of which was lost:
// n d^2 = z^2 d (1 - d).
TEST(Tango, IsWilsonsIntervalWhenNothingDiffers) {
  EXPECT_NEAR(tango({30, 0, 0, 10}).hi, wilson(0, 40).hi, 1e-12);
}

// Probability of a table of n throws.
double trinomial(std::int64_t lost, std::int64_t gained, std::int64_t n, double p_lost,
                 double p_gained) {
  return binomial_pmf(gained, n, p_gained) *
         binomial_pmf(lost, n - gained, std::min(1.0, p_lost / (1 - p_gained)));
}

double coverage_of_tango(std::int64_t n, double p_lost, double p_gained) {
  double coverage = 0;
  for (std::int64_t lost = 0; lost <= n; ++lost) {
    for (std::int64_t gained = 0; lost + gained <= n; ++gained) {
      const double probability = trinomial(lost, gained, n, p_lost, p_gained);
      if (probability < 1e-9) continue;
      const Interval interval = tango({n - lost - gained, lost, gained, 0});
      if (interval.contains(p_gained - p_lost)) coverage += probability;
    }
  }
  return coverage;
}

TEST(Tango, CoversAsItPromises) {
  double sum = 0, least = 1;
  int rates = 0;
  for (double p_lost = 0.02; p_lost < 0.6; p_lost += 0.04) {
    for (double p_gained = 0.02; p_gained <= std::min(p_lost, 1 - p_lost); p_gained += 0.04) {
      const double coverage = coverage_of_tango(40, p_lost, p_gained);
      sum += coverage;
      least = std::min(least, coverage);
      ++rates;
    }
  }
  RecordProperty("mean_coverage", std::to_string(sum / rates));
  RecordProperty("least_coverage", std::to_string(least));
  EXPECT_NEAR(sum / rates, 0.951, 0.004);
  EXPECT_GT(least, 0.93);
  // Between the points of that grid and its border.
  EXPECT_NEAR(coverage_of_tango(40, 0.202, 0.002), 0.929, 0.001);
}

// Fagerland, Lydersen and Laake 2014, whose ratio is first / second.
TEST(BonettPrice, AgreesWithThePublishedInterval) {
  const Interval interval = bonett_price({59, 16, 6, 80});
  EXPECT_NEAR(interval.lo, 0.7579, 5e-5);
  EXPECT_NEAR(interval.hi, 0.9910, 5e-5);
}

TEST(BonettPrice, MirrorsAndHasAWidthEverywhere) {
  for (const PairedCounts& counts : {kBentur, kCavo, PairedCounts{80, 0, 0, 0},
                                     PairedCounts{80, 0, 0, 20}, PairedCounts{1, 1, 1, 1}}) {
    const Interval interval = bonett_price(counts);
    const Interval mirrored =
        bonett_price({counts.both, counts.only_second, counts.only_first, counts.neither});
    EXPECT_NEAR(interval.lo * mirrored.hi, 1, 1e-12);
    EXPECT_LT(interval.lo, interval.hi);
    const double seen = static_cast<double>(counts.both + counts.only_second) /
                        static_cast<double>(counts.both + counts.only_first);
    EXPECT_TRUE(interval.contains(seen));
    EXPECT_GT(bonett_price(counts, 0.99).half_width(), interval.half_width());
  }
  EXPECT_EQ(bonett_price({0, 13, 0, 7}).lo, 0);
  EXPECT_GT(bonett_price({0, 13, 0, 7}).hi, 0.1);
  EXPECT_TRUE(std::isinf(bonett_price({0, 0, 13, 7}).hi));
  EXPECT_GT(bonett_price({0, 0, 13, 7}).lo, 1);
  EXPECT_TRUE(std::isinf(bonett_price({0, 0, 0, 7}).hi));
  EXPECT_THROW(bonett_price({0, -1, 0, 7}), std::invalid_argument);
}

double coverage_of_bonett_price(std::int64_t n, double p_both, double p_lost, double p_gained) {
  const double ratio = (p_both + p_gained) / (p_both + p_lost);
  double coverage = 0;
  for (std::int64_t both = 0; both <= n; ++both) {
    const double p_of_both = binomial_pmf(both, n, p_both);
    for (std::int64_t lost = 0; both + lost <= n; ++lost) {
      for (std::int64_t gained = 0; both + lost + gained <= n; ++gained) {
        const double probability =
            p_of_both *
            trinomial(lost, gained, n - both, p_lost / (1 - p_both), p_gained / (1 - p_both));
        if (probability < 1e-9) continue;
        const Interval interval = bonett_price({both, lost, gained, n - both - lost - gained});
        if (interval.contains(ratio)) coverage += probability;
      }
    }
  }
  return coverage;
}

TEST(BonettPrice, CoversAsItPromises) {
  double sum = 0, least = 1;
  int rates = 0;
  for (double p_both = 0.1; p_both < 0.8; p_both += 0.2) {
    for (double p_lost = 0.02; p_lost < 0.9 - p_both; p_lost += 0.1) {
      for (double p_gained = 0.02; p_gained <= p_lost && p_both + p_lost + p_gained < 0.95;
           p_gained += 0.1) {
        const double coverage = coverage_of_bonett_price(40, p_both, p_lost, p_gained);
        sum += coverage;
        least = std::min(least, coverage);
        ++rates;
      }
    }
  }
  RecordProperty("mean_coverage", std::to_string(sum / rates));
  RecordProperty("least_coverage", std::to_string(least));
  EXPECT_NEAR(sum / rates, 0.956, 0.004);
  EXPECT_GT(least, 0.94);
  EXPECT_NEAR(coverage_of_bonett_price(40, 0.946, 0.05, 0.002), 0.871, 0.001);
}

// Standardised difference of losses and gains under the most likely rates with lost - gained =
// margin, found by search.
double statistic_by_search(double lost, double gained, double n, double margin) {
  const auto log_likelihood = [&](double p_gained) {
    const double p_lost = p_gained + margin, same = 1 - p_lost - p_gained;
    const auto part = [](double count, double p) { return count == 0 ? 0 : count * std::log(p); };
    return part(lost, p_lost) + part(gained, p_gained) + part(n - lost - gained, same);
  };
  double lo = std::max(0.0, -margin), hi = 0.5 * (1 - margin);
  for (int i = 0; i < 200; ++i) {
    const double left = lo + (hi - lo) / 3, right = hi - (hi - lo) / 3;
    (log_likelihood(left) < log_likelihood(right) ? lo : hi) =
        log_likelihood(left) < log_likelihood(right) ? left : right;
  }
  const double variance = n * (2 * lo + margin - margin * margin);
  const double excess = lost - gained - n * margin;
  return std::abs(excess) < 1e-9 ? 0 : excess / std::sqrt(variance);
}

TEST(DropPValue, IsTheLargestProbabilityOfTablesAsExtreme) {
  constexpr std::int64_t n = 9;
  for (const double margin : {0.0, 0.1, -0.15}) {
    double statistic[n + 1][n + 1];
    for (std::int64_t b = 0; b <= n; ++b) {
      for (std::int64_t c = 0; b + c <= n; ++c) {
        statistic[b][c] =
            statistic_by_search(static_cast<double>(b), static_cast<double>(c), n, margin);
      }
    }
    for (const auto& [lost, gained] :
         {std::pair{0, 0}, {1, 0}, {3, 0}, {0, 2}, {4, 1}, {6, 2}, {5, 4}}) {
      double largest = 0;
      for (int i = 0; i <= 1024; ++i) {
        const double q = 0.5 * (1 - std::abs(margin)) * i / 1024;
        double sum = 0;
        for (std::int64_t b = 0; b <= n; ++b) {
          for (std::int64_t c = 0; b + c <= n; ++c) {
            if (statistic[b][c] < statistic[lost][gained] - 1e-6) continue;
            sum += trinomial(b, c, n, q + std::max(0.0, margin), q + std::max(0.0, -margin));
          }
        }
        largest = std::max(largest, sum);
      }
      const double p_value = drop_p_value({n - lost - gained, lost, gained, 0}, margin);
      EXPECT_NEAR(p_value, largest, 1e-5) << margin << ": " << lost << " " << gained;
      EXPECT_GE(p_value, largest - 1e-12);
    }
  }
}

// Whatever the true rates, a drop within the margin is taken for more with no more than the level:
// also inside of the null, where the p-value does not look.
TEST(DropPValue, KeepsEveryLevel) {
  const std::int64_t n = 14;
  for (const double margin : {0.0, 0.05, -0.1}) {
    std::vector<std::vector<double>> p_values(n + 1);
    for (std::int64_t lost = 0; lost <= n; ++lost) {
      for (std::int64_t gained = 0; lost + gained <= n; ++gained) {
        p_values[static_cast<std::size_t>(lost)].push_back(
            drop_p_value({n - lost - gained, lost, gained, 0}, margin));
      }
    }
    for (const double level : {0.01, 0.05, 0.1, 0.3}) {
      double largest = 0;
      for (double p_gained = 0; p_gained < 1; p_gained += 0.04) {
        for (double p_lost = 0; p_lost <= std::min(1 - p_gained, p_gained + margin);
             p_lost += 0.01) {
          double rejected = 0;
          for (std::int64_t lost = 0; lost <= n; ++lost) {
            for (std::int64_t gained = 0; lost + gained <= n; ++gained) {
              const double p_value =
                  p_values[static_cast<std::size_t>(lost)][static_cast<std::size_t>(gained)];
              if (p_value <= level) rejected += trinomial(lost, gained, n, p_lost, p_gained);
            }
          }
          EXPECT_LE(rejected, level + 1e-6) << p_lost << " " << p_gained << " " << margin;
          largest = std::max(largest, rejected);
        }
      }
      EXPECT_GT(largest, 0.2 * level);  // and it does reject
    }
  }
}

TEST(DropPValue, FallsWithLossesAndRisesWithTheMargin) {
  double previous = 1;
  for (std::int64_t lost = 0; lost <= 20; ++lost) {
    const double p_value = drop_p_value({180 - lost, lost, 4, 16}, 0.02);
    EXPECT_LE(p_value, previous);
    EXPECT_GE(p_value, 0);
    EXPECT_LE(drop_p_value({180 - lost, lost, 4, 16}, 0.01), p_value);
    previous = p_value;
  }
  EXPECT_LT(previous, 0.01);
  EXPECT_EQ(drop_p_value({}, 0.02), 1);
  EXPECT_THROW(drop_p_value(kCavo, 1), std::invalid_argument);
  EXPECT_THROW(drop_p_value(kCavo, -1), std::invalid_argument);
}

TEST(DropPValue, AgreesWithTheNormalApproximationForManyThrows) {
  // 600 lost and 540 gained of 20,000 against a margin of 0.1 %.
  const double z = 40 / std::sqrt(1140.0);
  const double p_value = drop_p_value({15'000, 600, 540, 3'860}, 0.001);
  EXPECT_NEAR(p_value, 0.5 * std::erfc(z / std::sqrt(2)), 0.001);
}

TEST(JudgeDrop, TellsFallenFromKeptFromTooFewThrows) {
  const DropVerdict fallen = judge_drop({160, 30, 2, 8}, 0.05);
  EXPECT_NEAR(fallen.drop, 28.0 / 200, 1e-15);
  EXPECT_TRUE(fallen.fell);
  EXPECT_FALSE(fallen.kept);
  const DropVerdict kept = judge_drop({180, 2, 3, 15}, 0.05);
  EXPECT_FALSE(kept.fell);
  EXPECT_TRUE(kept.kept);
  const DropVerdict unknown = judge_drop({18, 1, 0, 1}, 0.05);
  EXPECT_FALSE(unknown.fell);
  EXPECT_FALSE(unknown.kept);
  EXPECT_FALSE(judge_drop({}, 0.05).fell);
  EXPECT_FALSE(judge_drop({}, 0.05).kept);
  EXPECT_THROW(judge_drop(kCavo, -0.01), std::invalid_argument);
  EXPECT_THROW(judge_drop(kCavo, 0.05, 1), std::invalid_argument);
}

// When no outcome of n throws differs, a drop of the margin would have had that chance of
// (1 - margin)^n.
TEST(JudgeDrop, UnchangedThrowsNeverFellAndAreKeptOnceThereAreEnough) {
  for (const std::int64_t n : {20, 58, 59, 400}) {
    const DropVerdict verdict = judge_drop({n, 0, 0, 0}, 0.05);
    EXPECT_FALSE(verdict.fell);
    EXPECT_EQ(verdict.kept, n >= 59);
    if (n < 60) {
      EXPECT_NEAR(verdict.p_kept, std::pow(0.95, static_cast<double>(n)), 2e-6);
    }
  }
}

TEST(JudgeDrop, ConfidenceDecides) {
  const PairedCounts counts{170, 14, 3, 13};
  const DropVerdict verdict = judge_drop(counts, 0.01);
  ASSERT_GT(verdict.p_fell, 0.001);
  ASSERT_LT(verdict.p_fell, 0.05);
  EXPECT_TRUE(verdict.fell);
  EXPECT_FALSE(judge_drop(counts, 0.01, 1 - 0.9 * verdict.p_fell).fell);
}

}  // namespace
}  // namespace dodgesim
