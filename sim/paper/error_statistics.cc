#include "sim/paper/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "sim/paper/bootstrap.h"

namespace dodgesim {

namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Half way between the two in the middle, which is what estimate_quantile() calls the median.
double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

using Clusters = std::vector<std::vector<double>>;

std::vector<double> joined(const Clusters& clusters, std::span<const std::size_t> which) {
  std::vector<double> all;
  for (const std::size_t k : which) {
    all.insert(all.end(), clusters[k].begin(), clusters[k].end());
  }
  return all;
}

}  // namespace

std::optional<ErrorStatistics> error_statistics(const std::vector<PositionError>& errors,
                                                std::string_view name) {
  if (errors.empty()) return std::nullopt;
  std::map<int, std::vector<double>> by_throw;
  std::vector<double> all;
  for (const PositionError& error : errors) {
    by_throw[error.throw_index].push_back(error.error_m);
    all.push_back(error.error_m);
  }
  ErrorStatistics statistics;
  statistics.throws = static_cast<int>(by_throw.size());
  statistics.detections = static_cast<int>(all.size());
  statistics.mean = mean_of(all);
  statistics.median = median_of(all);
  double squares = 0, deviations = 0;
  for (const double error : all) {
    const double deviation = std::abs(error - statistics.mean);
    squares += deviation * deviation;
    deviations += deviation;
    statistics.largest_deviation = std::max(statistics.largest_deviation, deviation);
  }
  const auto n = static_cast<double>(all.size());
  statistics.sd = all.size() > 1 ? std::sqrt(squares / (n - 1)) : 0;
  statistics.mean_deviation = deviations / n;

  Clusters clusters;
  for (auto& [index, cluster] : by_throw) clusters.push_back(std::move(cluster));
  statistics.mean_interval = cluster_bootstrap(
      clusters.size(), name, [&](auto which) { return mean_of(joined(clusters, which)); });
  statistics.median_interval = cluster_bootstrap(clusters.size(), name, [&](auto which) {
    std::vector<double> drawn = joined(clusters, which);
    return median_of(drawn);
  });
  return statistics;
}

}  // namespace dodgesim
