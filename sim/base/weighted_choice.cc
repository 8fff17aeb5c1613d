#include "sim/base/weighted_choice.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "sim/base/random.h"

namespace dodgesim {

WeightedChoice::WeightedChoice(std::span<const double> weights) : places_(weights.size()) {
  const double mean =
      std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(weights.size());
  std::vector<double> left(weights.size());  // weight that has no place yet; a place holds 1
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    left[i] = weights[i] / mean;
    (left[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t filled = small.back(), giver = large.back();
    small.pop_back();
    places_[filled] = {left[filled], giver};
    left[giver] -= 1 - left[filled];
    if (left[giver] < 1) {
      large.pop_back();
      small.push_back(giver);
    }
  }
  // What rounding leaves over gets a whole place, unless its weight is 0.
  const auto heaviest =
      static_cast<std::uint32_t>(std::distance(weights.begin(), std::ranges::max_element(weights)));
  for (const std::uint32_t i : small) places_[i] = {weights[i] > 0 ? 1.0 : 0.0, heaviest};
}

std::uint32_t WeightedChoice::pick(std::uint32_t bits, std::uint32_t more_bits) const {
  const std::uint64_t place = (std::uint64_t{bits} * places_.size()) >> 32;
  const Place& chosen = places_[static_cast<std::size_t>(place)];
  const bool own = unit_interval(more_bits) < chosen.own_share;
  return own ? static_cast<std::uint32_t>(place) : chosen.other;
}

}  // namespace dodgesim
