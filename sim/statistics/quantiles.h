// Quantiles of a sample with intervals that hold whatever its distribution.
#pragma once

#include <optional>
#include <span>

#include "sim/statistics/interval.h"

namespace dodgesim {

struct QuantileEstimate {
  double value = 0;
  Interval interval;  // an end is infinite where the sample is too small to bound that side
};

// Quantile of a share in [0, 1] of the distribution that the sample was drawn from; empty for an
// empty sample.
//   value     Definition 8 of Hyndman and Fan 1996 (The American Statistician 50:361), which they
//             recommend: its median is near the true quantile whatever the distribution. R's
//             quantile(type = 8); NumPy's method "median_unbiased".
//   interval  Between two order statistics, each tail of the binomial at most (1 - confidence) / 2
//             (Conover 1999, Practical Nonparametric Statistics, section 3.2): covers with the
//             confidence or more, whether or not the distribution has steps.
// `sorted` must ascend and may end with +infinity (that which never happened). Throws
// std::invalid_argument when it does not ascend or has a NaN or -infinity.
std::optional<QuantileEstimate> estimate_quantile(std::span<const double> sorted, double share,
                                                  double confidence = 0.95);

}  // namespace dodgesim
