// The throws through the field of view that Tables 1 and 2 share.
#pragma once

#include <string>

#include "sim/paper/experiment.h"

namespace dodgesim {

// 100 throws of each category of sizes.
PaperFlight stereo_passing();

// 100 balls of a size that the pilot knows.
PaperFlight mono_passing(const std::string& size_m);

}  // namespace dodgesim
