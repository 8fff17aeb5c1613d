// What differs between two scenarios, for people.
#pragma once

#include <string>
#include <vector>

namespace dodgesim {

// A key that differs, and its values as text.
struct ScenarioChange {
  std::string key;     // dotted
  std::string before;  // "3500", "!uniform [4, 6]", or "unset"
  std::string after;
};

// Both are YAML, every value spelled out (to_yaml()); names and descriptions are left out. Throws
// ScenarioError for what is no YAML map.
std::vector<ScenarioChange> scenario_changes(const std::string& before, const std::string& after);

// How one scenario differs from another: "seed is 3, not 4, and 2 more keys differ".
std::string scenario_difference(const std::string& of, const std::string& from);

}  // namespace dodgesim
