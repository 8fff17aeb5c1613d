// Presets: `pilot` sets the defaults of all keys of `dodger`, sensors.events.preset those of the
// camera.
#pragma once

#include "sim/config/reader.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// A file that gives all keys of a group, as a resolved scenario does, leaves nothing for a preset
// to decide. Adds a problem if `root`, which is `file` with the settings of the command line, then
// has another preset.
void check_set_presets(const YamlNode& file, const YamlNode& root, ReadContext& context);

// Adds a problem for each key that the scenario gives and that would hold with some values of its
// grid or sweep only, because others bring their own.
void check_varied_presets(const Scenario& scenario, ReadContext& context);

}  // namespace dodgesim
