// Builds a world where a crash does no harm.
#pragma once

#include "sim/world/compose.h"

namespace dodgesim {

struct TrialLimits {
  int wall_ms = 30000;
  int memory_mb = 3072;
};

// Compiles the models in a child process, builds the world and lets it run for some ticks, because
// MuJoCo may crash, hang or eat up the memory over a broken file. Throws ScenarioError with one
// sentence if that happens or if the models are no good; SimulationError if no process can be made.
// Call before the process has threads or a GL context.
void try_world(const WorldSpec& spec, const TrialLimits& limits = {});

}  // namespace dodgesim
