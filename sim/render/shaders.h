// GLSL sources of the luminance renderer.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

namespace dodgesim {

struct LightCount {
  int directional = 0;
  int lamps = 0;  // lights with a position
};

enum class TextureKind { kNone, k2d, kCube };

// The sources assume that GL's window rows run from the top of the image down: gl_FragCoord.xy is
// the pixel position plus (0.5, 0.5). Output 0: luminance (and coverage as alpha), output 1: id.
std::string triangle_vertex_shader(const LightCount& lights);
std::string triangle_fragment_shader(TextureKind texture, const LightCount& lights);
std::string primitive_vertex_shader(const LightCount& lights);
// type: mjGEOM_ELLIPSOID, mjGEOM_CAPSULE, mjGEOM_CYLINDER or mjGEOM_BOX. hard: depth and id where
// the pixel's centre is hit; else luminance with the coverage of the pixel as alpha.
std::string primitive_fragment_shader(mjtGeom type, TextureKind texture, const LightCount& lights,
                                      bool hard);
std::string sky_vertex_shader();
std::string sky_fragment_shader(TextureKind texture);

// Smooths the static scene along its edges; see luminance_renderer.h.
std::string edge_vertex_shader();
std::string edge_fragment_shader();

}  // namespace dodgesim
