#include "sim/paper/bootstrap.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "sim/base/random.h"
#include "sim/statistics/quantiles.h"

namespace dodgesim {

Interval cluster_bootstrap(std::size_t clusters, std::string_view name,
                           const std::function<double(std::span<const std::size_t>)>& statistic) {
  constexpr int kSamples = 1000;
  constexpr double kTail = 0.025;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (clusters == 0) throw std::invalid_argument("There are no clusters to draw from.");
  if (clusters < kLeastClusters) return {-kInfinity, kInfinity};
  RandomStream random(0, 0, name);
  std::vector<double> values;
  std::vector<std::size_t> drawn(clusters);
  for (int i = 0; i < kSamples; ++i) {
    for (std::size_t& pick : drawn) {
      pick = static_cast<std::size_t>(random.uniform() * static_cast<double>(clusters));
    }
    values.push_back(statistic(drawn));
  }
  std::ranges::sort(values);
  return {estimate_quantile(values, kTail)->value, estimate_quantile(values, 1 - kTail)->value};
}

}  // namespace dodgesim
