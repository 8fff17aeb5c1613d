// Textures of ray-cast solids: each level is half as large as the one before, its texels being
// means over those that they cover, and has a border of one texel on all sides, so that reading
// between texels needs no special cases. Of a 2-D texture, which repeats, the border is the
// opposite side; of a cube's face the neighbouring faces, as OpenGL's seamless cube maps have it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/render/scene_geometry.h"

namespace dodgesim {

struct TexturePyramid {
  static constexpr std::size_t kMostLevels = 16;

  bool cube = false;
  int levels = 0, width = 0, height = 0;  // of a face of the first level, without its border
  // Where each level begins in `pairs`: with the texel (-1, -1) of the first face, which is of its
  // border. Faces follow one another, in OpenGL's order.
  std::array<int, kMostLevels> first{};
  // A texel in the lower 16 bits and its right neighbour in the upper ones, so that one reading
  // gives both, in units of `unit` luminances. Linear grey texels of 8 bits without a tint are
  // exact.
  std::vector<std::uint32_t> pairs;
  float unit = 0;
};

TexturePyramid make_pyramid(const LuminanceTexture& texture);

}  // namespace dodgesim
