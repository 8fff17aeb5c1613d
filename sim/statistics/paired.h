// Comparison of two campaigns throw by throw: both flew the same throws with the same noise.
#pragma once

#include "sim/statistics/interval.h"
#include "sim/statistics/unpaired.h"

namespace dodgesim {

// The throws by what came of them in the first campaign (the baseline) and in the second.
struct PairedCounts {
  std::int64_t both = 0;         // success in both
  std::int64_t only_first = 0;   // lost
  std::int64_t only_second = 0;  // gained
  std::int64_t neither = 0;

  std::int64_t total() const { return both + only_first + only_second + neither; }
  void add(bool first, bool second) {
    ++(first ? (second ? both : only_first) : (second ? only_second : neither));
  }
};

// The functions below throw std::invalid_argument when a count is negative.

// McNemar's exact test, p-value: of the throws with a different outcome, each half of them is
// expected to be lost (binomial; Fagerland, Lydersen and Laake 2013, BMC Medical Research
// Methodology 13:91, supplement, equation 1). kLower: the second rate is lower. 1 when no outcome
// differs.
double mcnemar(const PairedCounts& counts, Alternative alternative = Alternative::kDifferent);

// Interval of second rate - first rate: Tango's score interval (Tango 1998, Statistics in Medicine
// 17:891), one of those that Fagerland, Lydersen and Laake 2014 (Statistics in Medicine 33:2850)
// recommend. Chosen over Newcombe's paired interval because it belongs to the statistic by which
// drop_p_value() orders, and because its coverage is close to the confidence: at 95 %, by
// enumeration for 20 to 100 throws, 0.950 to 0.956 on average over the rates and 0.928 at least. A
// single end of it may be wrong in 9 % instead of 5 % of campaigns at rare differences: decide with
// drop_p_value(). [-1, 1] when there were no throws.
Interval tango(const PairedCounts& counts, double confidence = 0.95);

// Interval of second rate / first rate: Bonett and Price's hybrid of two Wilson intervals (Bonett
// and Price 2006, Statistics in Medicine 25:3039), which Fagerland, Lydersen and Laake 2014
// recommend. Its coverage at 95 %, by enumeration for 40 throws, is 0.956 on average over the rates
// and 0.944 at least where each of the four outcomes has a probability of 0.05 or more. It is lower
// where nearly all throws agree and the others differ one way: 0.87 if 5 % are lost and next to
// none gained (for 100 throws 0.93 at least). Unlike a bootstrap it has a width where all throws
// agree or one rate is 0. Infinite above when nothing succeeded in the first campaign; [0,
// infinity] when nothing did in either.
Interval bonett_price(const PairedCounts& counts, double confidence = 0.95);

// p-value against "the success rate fell by at most `margin`" (-1 < margin < 1): small when it fell
// by more. Exact and unconditional: tables ordered by Tango's statistic at the margin, the largest
// probability over the unknown rate of gained throws (Hsueh, Liu and Chen 2001, Biometrics 57:478),
// of which 1e-6, added to the p-value, is set aside for rates that the throws refute (Berger and
// Boos 1994, Journal of the American Statistical Association 89:1012). Never rejects a true null
// too often, at any number of throws. 1 when there were none. Takes 10 ms for 1000 throws.
double drop_p_value(const PairedCounts& counts, double margin);

// What a regression gate asks of two campaigns on the same throws.
struct DropVerdict {
  double drop = 0;    // first rate - second rate, as seen
  double p_fell = 1;  // against "fell by at most the margin"
  double p_kept = 1;  // against "fell by the margin or more"
  bool fell = false;  // shown: the rate fell by more than the margin
  bool kept = false;  // shown: it did not fall by the margin (non-inferiority)
  // Neither: too few throws to tell.
};

// Each of the two statements is wrong with a probability of at most 1 - confidence. Requires
// 0 <= margin < 1.
DropVerdict judge_drop(const PairedCounts& counts, double margin, double confidence = 0.95);

}  // namespace dodgesim
