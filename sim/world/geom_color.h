// The colour of a geom, as MuJoCo's own renderer shows it.
#pragma once

#include <mujoco/mujoco.h>

#include "sim/world/compose.h"

namespace dodgesim {

// Red, green, blue and alpha in the model. The geom's own count unless they are MuJoCo's default
// and there is a material.
inline const float* geom_color(const mjModel& model, int geom) {
  const float* own = model.geom_rgba + 4 * geom;
  const bool is_default = own[0] == 0.5f && own[1] == 0.5f && own[2] == 0.5f && own[3] == 1.0f;
  const int material = model.geom_matid[geom];
  return material >= 0 && is_default ? model.mat_rgba + 4 * material : own;
}

// Whether the cameras see it, if it is of the room or of an object.
inline bool is_drawn(const mjModel& model, int geom) {
  return model.geom_group[geom] < kFirstHiddenGroup && geom_color(model, geom)[3] != 0;
}

}  // namespace dodgesim
