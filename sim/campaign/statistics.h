// Statistics of success counts.
#pragma once

namespace dodgesim {

struct Interval {
  double lo = 0;
  double hi = 1;
};

// Wilson score interval of a proportion (Wilson 1927), without continuity correction. Requires
// 0 <= successes <= trials; [0, 1] when there were no trials.
Interval wilson(int successes, int trials, double confidence = 0.95);

}  // namespace dodgesim
