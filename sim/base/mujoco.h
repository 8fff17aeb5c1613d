// RAII for MuJoCo, with its errors and warnings turned into exceptions.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace dodgesim {

struct MjModelDeleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
};
struct MjDataDeleter {
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using MjModelPtr = std::unique_ptr<mjModel, MjModelDeleter>;
using MjDataPtr = std::unique_ptr<mjData, MjDataDeleter>;

// Compiles MJCF text; includes and assets are found in the folder `directory`.
// Throws ScenarioError with MuJoCo's message, naming `label`; MemoryError for lack of memory.
// From then on mju_error throws SimulationError or MemoryError (by default it waits for a key and
// exits), after which the mjData must be discarded, and mju_warning is silent: check_warnings()
// reads its counters.
MjModelPtr compile_model(const std::string& xml, const std::string& directory,
                         const std::string& label);

// Throws SimulationError if MuJoCo has warned of what it cannot go on with.
void check_warnings(const mjData& data);

}  // namespace dodgesim
