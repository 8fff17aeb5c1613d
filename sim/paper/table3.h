// Table 3 of Falanga et al. 2020: how long the stages of the detection take, on this machine.
#pragma once

#include <vector>

#include "sim/bench/bench.h"
#include "sim/paper/experiment.h"

namespace dodgesim {

// `measured`: the quantities of pilot_cases().
PaperTables table3_of(const std::vector<Measurement>& measured);

}  // namespace dodgesim
