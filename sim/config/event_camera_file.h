// Event cameras by name, and from files of their own.
#pragma once

#include <string>
#include <vector>

#include "sim/events/spec.h"

namespace dodgesim {

// The names of the presets: ideal, sees1.
const std::vector<std::string>& event_camera_presets();

// A preset by its name or, for a name that ends in .yaml or .yml, the camera described in that
// file: it holds the keys of a scenario's sensors.events at its root, each with the same default.
// Throws ScenarioError like load_scenario() and for any other name, IoError when reading fails.
EventCameraSpec named_event_camera(const std::string& name_or_file);

}  // namespace dodgesim
