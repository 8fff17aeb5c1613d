// What a scenario is made of: its file, the files that it extends, and settings of the command
// line.
#pragma once

#include <string>
#include <vector>

#include "sim/config/yaml_tree.h"

namespace dodgesim {

// One key set from outside the file.
struct Setting {
  std::string key;    // dotted
  std::string value;  // YAML
  std::string shown;  // what the user wrote, to open messages: "--set seed=3"
};

// The tree of the scenario `text`, which stands in `file`: laid over the file that its key
// `extends` names, if any, and so on; and below the settings, in their order.
//
// A base is named relative to the file that names it. It must be a regular file that ends in .yaml
// or .yml and lies in the folder of `file`, below it, or at most two folders further up, wherever
// links lead; there are at most 8 of them. Maps merge; any other value takes the place of the
// base's, and ~ takes the base's away. A base's name and description do not count.
// Throws ScenarioError and IoError; lesser problems are added to `problems`.
YamlNode scenario_tree(const std::string& text, const std::string& file,
                       const std::vector<Setting>& settings, Problems& problems);

}  // namespace dodgesim
