// Keys of a scenario by their dotted paths.
#pragma once

#include <map>
#include <string>

namespace dodgesim {

// Whether there are keys below this one.
template <class Value>
bool is_group(const std::map<std::string, Value>& keys, const std::string& key) {
  const auto below = keys.lower_bound(key + ".");
  return below != keys.end() && below->first.starts_with(key + ".");
}

}  // namespace dodgesim
