// Presets among the values of a grid or sweep: pilot brings all keys of dodger,
// sensors.events.preset those of the camera.
#pragma once

#include "sim/config/reader.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// Adds a problem for each key that the scenario gives and that would hold with some values of the
// axis only, because others bring their own.
void check_presets(const Scenario& scenario, const VariedKey& axis, ReadContext& context);

}  // namespace dodgesim
