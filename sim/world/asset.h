// The files that a model names: meshes and textures.
#pragma once

#include <string>
#include <vector>

#include "sim/world/mjcf.h"

namespace dodgesim {

// Refuses, of the files in `directory` that `tags` name, what MuJoCo 2.2 would read otherwise than
// its author means, or beyond the end of its arrays (sim/world/obj_check.h; textures that are not
// PNG), and textures of more than 4096 x 4096 pixels. What MuJoCo refuses is left to it.
// Throws ScenarioError, naming `label`, which is the model's file, a line of it and the file.
void check_assets(const std::vector<MjcfTag>& tags, const std::string& directory,
                  const std::string& label);

}  // namespace dodgesim
