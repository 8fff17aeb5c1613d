#include "sim/campaign/statistics.h"

#include <cmath>

#include "sim/base/random.h"

namespace dodgesim {

Interval wilson(int successes, int trials, double confidence) {
  if (trials == 0) return {0, 1};
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  const double n = trials;
  const double p = successes / n;
  const double centre = p + z * z / (2 * n);
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  const double scale = 1 + z * z / n;
  // At the ends the bounds are exactly 0 and 1, which rounding would miss.
  return {successes == 0 ? 0 : (centre - half) / scale,
          successes == trials ? 1 : (centre + half) / scale};
}

}  // namespace dodgesim
