// Quantiles of a sample.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace dodgesim {

// Standard deviation of the median of many normal values, by that of their mean: sqrt(pi / 2).
inline constexpr double kMedianSigma = 1.2533;

// The value that the given share (0 to 1) of all others is not above; of an even number of values,
// 0.5 gives the lower middle. NaN for none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

}  // namespace dodgesim
