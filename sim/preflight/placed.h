// Where in a scenario a mistake stands that only its models or its throws show.
#pragma once

#include <string>

#include "sim/config/scenario.h"

namespace dodgesim {

// "file:line:column" of the first dotted key that the message names and that the scenario gives,
// the longest of those at one place in it; empty if there is none. A key without a dot, such as
// name, may be a word of any sentence.
std::string place_named_in(const std::string& message, const Scenario& campaign);

// "file:line:column" of a dotted key that the scenario gives; empty if it does not.
std::string place_of_key(const std::string& key, const Scenario& campaign);

// "place: message", or the message alone.
std::string placed(const std::string& message, const std::string& place);

}  // namespace dodgesim
