// Values in lists.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>

namespace dodgesim {

// Whether a value is in the list, or is the projection of one there. (C++20 has no
// std::ranges::contains.)
template <class List, class Value, class Projection = std::identity>
bool contains(const List& list, const Value& value, Projection projection = {}) {
  return std::ranges::find(list, value, projection) != std::ranges::end(list);
}

// Where it stands first; empty if it is not there.
template <class List, class Value>
std::optional<std::size_t> index_of(const List& list, const Value& value) {
  const auto found = std::ranges::find(list, value);
  if (found == std::ranges::end(list)) return std::nullopt;
  return static_cast<std::size_t>(found - std::ranges::begin(list));
}

}  // namespace dodgesim
