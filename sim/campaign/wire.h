// A result as bytes, for the way from a worker process to the campaign on the same machine.
#pragma once

#include <string>
#include <string_view>

#include "sim/campaign/result.h"

namespace dodgesim {

std::string to_bytes(const ThrowResult& result);

// Throws SimulationError when the bytes are not those of one whole result.
ThrowResult result_from_bytes(std::string_view bytes);

}  // namespace dodgesim
