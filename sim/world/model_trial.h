// Builds a world where a crash does no harm.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "sim/world/compose.h"
#include "sim/world/world.h"

namespace dodgesim {

// Where a vehicle is to be.
struct VehiclePlace {
  std::string key;                                // of the scenario, which says so
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  // [m]
  double heading_rad = 0;
};

// Throws ScenarioError if a world that can be built is still no good for what it is meant for.
using WorldCheck = std::function<void(const World&)>;

struct TrialLimits {
  int wall_ms = 30000;
  int memory_mb = 3072;
};

// Compiles the models in a child process, builds the world and lets it run for some ticks, because
// MuJoCo may crash, hang or eat up the memory over a broken file. Throws ScenarioError with one
// sentence if that happens, if the models are no good, if the vehicle touches the room, or is not
// in it, at one of the places, or what `check` throws; SimulationError if no process can be made.
// Call before the process has threads or a GL context.
void try_world(const WorldSpec& spec, const std::vector<VehiclePlace>& places = {},
               const WorldCheck& check = {}, const TrialLimits& limits = {});

}  // namespace dodgesim
