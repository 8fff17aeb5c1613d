// GLSL sources of the luminance renderer.
#pragma once

#include <string>

namespace dodgesim {

struct LightCount {
  int directional = 0;
  int lamps = 0;  // lights with a position
};

enum class TextureKind { kNone, k2d, kCube };

// The sources assume that GL's window rows run from the top of the image down: gl_FragCoord.xy is
// the pixel position plus (0.5, 0.5). Output 0: luminance (of edges with the part of the pixel
// beyond as alpha), output 1: id.
std::string triangle_vertex_shader(const LightCount& lights);
std::string triangle_fragment_shader(TextureKind texture, const LightCount& lights);
std::string sky_vertex_shader();
std::string sky_fragment_shader(TextureKind texture);

// Smooths the static scene along its edges; see luminance_renderer.h.
std::string edge_vertex_shader();
std::string edge_fragment_shader();

}  // namespace dodgesim
