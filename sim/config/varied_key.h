// Keys of a scenario that take several values: grid and sweep.
#pragma once

#include <string>
#include <vector>

#include "sim/config/yaml_tree.h"

namespace dodgesim {

// One key and its values, as they stand in YAML: numbers, distributions, names, lists.
struct VariedKey {
  std::string key;  // dotted path: "throw.size_m"
  Position at;
  std::vector<YamlNode> values;  // not empty
};

// Every combination of their values is wanted; the last one changes fastest.
using VariedKeys = std::vector<VariedKey>;

}  // namespace dodgesim
