// Intervals of proportions.
#pragma once

#include <cstdint>
#include <vector>

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
// The same for a quantile z of the normal distribution; unchecked, trials > 0.
Interval wilson_of_quantile(std::int64_t successes, std::int64_t trials, double z);
// The same of a share in [0, 1] of trials that come in clusters of the given sizes (all > 0), each
// of which may have succeeded or failed together: it is of (sum m)^2 / sum m^2 trials, the
// effective number under full correlation within a cluster. [0, 1] when there are no clusters.
Interval wilson_of_clusters(double share, const std::vector<std::int64_t>& sizes,
                            double confidence = 0.95);

// Exact interval of a proportion (Clopper and Pearson 1934): its coverage is never below the
// confidence, and mostly above. [0, 1] when there were no trials.
Interval clopper_pearson(std::int64_t successes, std::int64_t trials, double confidence = 0.95);

}  // namespace dodgesim
