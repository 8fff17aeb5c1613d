// The text of scenarios/README.md.
#pragma once

#include <string>

namespace dodgesim {

// An introduction and every key with its type, range, default and meaning.
std::string scenario_readme();

}  // namespace dodgesim
