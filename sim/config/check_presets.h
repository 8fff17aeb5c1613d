// Presets: pilot decides on all keys of dodger, sensors.events.preset on those of the camera.
#pragma once

#include "sim/config/reader.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// Where a file gives all keys of a group, as a resolved scenario does, another preset in `root`,
// which has the settings of the command line over `file`, would be one by its name only: a problem.
void check_set_presets(const YamlNode& file, const YamlNode& root, ReadContext& context);

// Adds a problem for each key that the scenario gives and that would hold with some values of its
// grid or sweep only, because others bring their own.
void check_varied_presets(const Scenario& scenario, ReadContext& context);

}  // namespace dodgesim
