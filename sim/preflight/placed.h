// Where in a scenario a mistake stands that only its models or its throws show.
#pragma once

#include <string>

#include "sim/config/scenario.h"

namespace dodgesim {

// The message behind the place of the first dotted key that it names and that the scenario gives,
// the longest of those at one place in it; a key without a dot, such as name, may be a word of any
// sentence.
std::string placed(const std::string& message, const Scenario& campaign);

}  // namespace dodgesim
