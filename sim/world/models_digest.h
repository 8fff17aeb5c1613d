// Did two campaigns fly the same models?
#pragma once

#include <cstdint>

#include "sim/world/compose.h"

namespace dodgesim {

// A number that changes with every element, attribute and asset of the models that the world is
// made of, but not with comments and blanks in their files, nor with the sizes of the objects.
// Throws ScenarioError as read_model_file() does.
std::uint64_t models_digest(const WorldSpec& spec);

}  // namespace dodgesim
