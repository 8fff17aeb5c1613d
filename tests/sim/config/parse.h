// A scenario from its text, for the tests.
#pragma once

#include <string>

#include "sim/config/scenario.h"

namespace dodgesim {

inline Scenario parse(const std::string& yaml) { return parse_scenario(yaml, "test.yaml", ""); }

}  // namespace dodgesim
