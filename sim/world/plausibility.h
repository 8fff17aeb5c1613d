// What a body of a model cannot be: slips of units and of modelling that MuJoCo would simulate
// without a word. All throw ScenarioError with one sentence that begins with `file`.
#pragma once

#include <string>

#include "sim/base/mujoco.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

// No point of the body's geoms is farther from its origin.
double farthest_m(const mjModel& model, int body);

// Neither more inertia than a body of its mass and reach can have, nor next to none.
void check_inertia(const mjModel& model, int body, const std::string& file);

// Nothing is denser than osmium.
void check_density(const mjModel& model, int body, const std::string& file);

// Rotors and cameras are on the vehicle or not far from it.
void check_mounts(const mjModel& model, int body, const VehicleParameters& vehicle,
                  const std::string& file);

// That rotors which turn a light vehicle do not lift it, too: roll and pitch come before collective
// thrust (sim/control/mixer.h). With less mass for its inertia the default controller climbs away
// in a limit cycle (nominal vehicle at 1.5 m/s: well behaved with 0.6 of its mass, 2.5 m above its
// goal with 0.5, gone with 0.4).
void check_turning(const VehicleParameters& vehicle, const std::string& file);

// The faces of its meshes turn counter-clockwise as seen from outside: others would be lit as if
// seen from within.
void check_faces(const mjModel& model, int geom, const std::string& file);

}  // namespace dodgesim
