// Intervals of proportions.
#pragma once

#include <cstdint>

namespace dodgesim {

struct Interval {
  double lo = 0;
  double hi = 1;

  double middle() const { return 0.5 * (lo + hi); }
  double half_width() const { return 0.5 * (hi - lo); }
  bool contains(double x) const { return lo <= x && x <= hi; }
};

// All functions of counts and confidences here and in paired.h, unpaired.h, quantiles.h and
// sequential.h throw std::invalid_argument unless 0 <= successes <= trials and 0 < confidence < 1.
void check_counts(std::int64_t successes, std::int64_t trials);
void check_confidence(double confidence);

// Wilson score interval of a proportion (Wilson 1927), without continuity correction: its coverage
// is close to the confidence on average over the true rates. [0, 1] when there were no trials.
Interval wilson(std::int64_t successes, std::int64_t trials, double confidence = 0.95);
// The same for a quantile z of the normal distribution; trials > 0.
Interval wilson_of_quantile(std::int64_t successes, std::int64_t trials, double z);

// Exact interval of a proportion (Clopper and Pearson 1934): its coverage is never below the
// confidence, and mostly above. [0, 1] when there were no trials.
Interval clopper_pearson(std::int64_t successes, std::int64_t trials, double confidence = 0.95);

}  // namespace dodgesim
