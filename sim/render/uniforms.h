// Uniforms that fragments read, by name: {"vec3", "camera"} is u_camera.
//
// For every eight pixels llvmpipe (Mesa 22.3) reads a uniform anew and checks its bounds, in some
// 27 instructions a component. A flat output of the vertex shader costs one and has the same bits.
// So vertex shaders declare them and hand them on.
#pragma once

#include <string>
#include <vector>

#include "sim/render/shaders.h"

namespace dodgesim::glsl {

struct Uniform {
  const char* type;  // float, int, vec<n>, mat<n>
  const char* name;
  int size = 0;  // of an array; 0: none
};
using Uniforms = std::vector<Uniform>;

std::string declared(const Uniforms& uniforms);

// In the vertex shader, whose main() calls hand_on(), and in the fragment shader.
std::string handed_on(const Uniforms& uniforms);
std::string received(const Uniforms& uniforms);

// Of distant_light() and lamp_light() in shaders.cc.
Uniforms distant_light_uniforms(const LightCount& lights);
Uniforms lamp_uniforms(const LightCount& lights);

// A fragment shader takes a limited number of inputs: lights may be too many to be handed on.
struct FragmentUniforms {
  Uniforms handed_on, declared;
};
FragmentUniforms with_lights(Uniforms own, const Uniforms& lights);

}  // namespace dodgesim::glsl
