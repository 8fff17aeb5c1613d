// What differs between two scenarios, for people.
#pragma once

#include <string>
#include <vector>

namespace dodgesim {

// Both are YAML, every value spelled out (to_yaml()). A line a key that differs: "delays.compute_us
// was 3500, is 23500"; names and descriptions are left out. Throws ScenarioError for what is no
// YAML map.
std::vector<std::string> scenario_changes(const std::string& before, const std::string& after);

}  // namespace dodgesim
