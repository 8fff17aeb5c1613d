// The result of a throw before any flight.
#pragma once

#include "sim/config/expand.h"
#include "sim/outcome/result.h"

namespace dodgesim {

// Its numbers as drawn, no pilot flown.
ThrowResult blank_result(const ThrowCase& thrown);

}  // namespace dodgesim
