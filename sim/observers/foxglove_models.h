// Bodies of a MuJoCo model as entities of a Foxglove scene.
#pragma once

#include <mujoco/mujoco.h>

#include <optional>

#include "sim/observers/foxglove.h"

namespace dodgesim::foxglove {

// Adds to `entity` what people see of the body (groups 0 to 3), in the body's frame; of a plane its
// outline. In the model's colours or in the given one.
void add_body(const mjModel& model, int body, const std::optional<Colour>& colour, Json& entity);

// The same of all that never moves, in the world.
void add_room(const mjModel& model, const Colour& colour, Json& entity);

}  // namespace dodgesim::foxglove
