// The figures of the paper's Table 1, of a sample of position errors.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "sim/statistics/interval.h"

namespace dodgesim {

// The error of one detection. Those of one throw are much alike.
struct PositionError {
  int throw_index = 0;
  double error_m = 0;
};

struct ErrorStatistics {
  int throws = 0;
  int detections = 0;
  double mean = 0, median = 0;  // the median as of estimate_quantile()
  double sd = 0;                // with n - 1; 0 for a single detection
  double mean_deviation = 0;    // mean of |error - mean|
  double largest_deviation = 0;
  Interval mean_interval, median_interval;  // cluster_bootstrap() over the throws
};

// Empty without errors. The random numbers of the bootstrap are those of `name`.
std::optional<ErrorStatistics> error_statistics(const std::vector<PositionError>& errors,
                                                std::string_view name);

}  // namespace dodgesim
