// What of a scenario matters to a recording: which pilot looks at it, with which keys and delays.
#pragma once

#include <string>
#include <vector>

#include "sim/config/scenario.h"
#include "sim/config/scenario_tree.h"

namespace dodgesim {

// That of `file`, or falanga2020's defaults if it is empty, below the settings, with the library
// `plugin`, if any. Names settings without effect on standard error. Throws ScenarioError where the
// pilot sees no events, is a plug-in without a library or has a library without being one, or where
// grid or sweep have several values of what matters.
Scenario detect_scenario(const std::string& file, const std::vector<Setting>& settings,
                         const std::string& plugin);

}  // namespace dodgesim
