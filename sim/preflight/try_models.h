// The models of a campaign.
#pragma once

#include <string>
#include <vector>

#include "sim/config/scenario.h"

namespace dodgesim {

// Tries every room with every vehicle, all objects and every start that a campaign names, each such
// world once, in child processes. Throws ScenarioError as try_world() does, if a pilot's cameras
// cannot see all of a room or an object, if stereo cannot use its vehicle's cameras, if the mixer
// cannot use its rotors, if a rotor's idle thrust is not less than its greatest or lifts a quarter
// of the vehicle, or if the controller may not command enough thrust to fly.
void try_models(const std::vector<Scenario>& campaigns);

// Hexadecimal digits that change with these models (models_digest.h). Throws ScenarioError.
std::string digest_of_models(const Scenario& campaign);

}  // namespace dodgesim
