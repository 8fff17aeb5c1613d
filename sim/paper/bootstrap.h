// Intervals for samples that come in clusters: what one throw yields is not independent.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "sim/statistics/interval.h"

namespace dodgesim {

// The 95 % interval of a statistic of `clusters` clusters: percentiles over 1000 samples of as many
// clusters, drawn with replacement (Davison and Hinkley 1997, Bootstrap Methods, section 3.8). The
// statistic gets the numbers of the drawn clusters. Random numbers are those of `name`. Throws
// std::invalid_argument without clusters.
Interval cluster_bootstrap(std::size_t clusters, std::string_view name,
                           const std::function<double(std::span<const std::size_t>)>& statistic);

}  // namespace dodgesim
