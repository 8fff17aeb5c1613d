// Event cameras by name, and from files of their own.
#pragma once

#include <string>

#include "sim/config/scenario.h"

namespace dodgesim {

// A preset of EventCameraSpec by its name or, for a name that ends in .yaml or .yml, the camera
// described in that file: it holds the keys of a scenario's sensors.events at its root, `preset`
// among them, each with the same default, or it is a scenario itself. Throws ScenarioError like
// load_scenario() and for any other name, IoError when reading fails.
EventCameraSpec named_event_camera(const std::string& name_or_file);

// All sensors: those of a scenario, none of which may vary within it, else the defaults with that
// event camera.
SensorsSpec named_sensors(const std::string& name_or_file);

}  // namespace dodgesim
