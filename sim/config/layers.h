// Puts trees of YAML together: a file over its base, a setting of the command line over both.
#pragma once

#include <string>

#include "sim/config/yaml_tree.h"

namespace dodgesim {

// Adds the keys of the map `over` to the map `base`. Where both have a key, maps without a tag
// merge in the same way (grid and sweep also where one calls a key throw.size_m and the other
// size_m), ~ (or null) takes the key away, and any other value, also a forgotten one, takes the
// base's place.
void lay_over(YamlNode& base, const YamlNode& over);

// Sets the value of a dotted key, making the maps on its way. What follows `grid.` and `sweep.` is
// one key, dots and all.
void set_value(YamlNode& root, const std::string& key, const YamlNode& value);

}  // namespace dodgesim
