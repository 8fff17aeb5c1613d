#include "sim/render/uniforms.h"

#include <algorithm>
#include <utility>

namespace dodgesim::glsl {

namespace {

// Of 32, with some to spare for outputs of the vertices.
constexpr int kMostInputs = 28;

std::string declaration(const char* kind, const char* prefix, const Uniform& uniform) {
  std::string text = kind;
  text.append(" ").append(uniform.type).append(" ").append(prefix).append(uniform.name);
  if (uniform.size > 0) text.append("[").append(std::to_string(uniform.size)).append("]");
  return text.append(";\n");
}

// Every vector and every column of a matrix takes one.
int inputs(const Uniforms& uniforms) {
  int sum = 0;
  for (const Uniform& uniform : uniforms) {
    const std::string type = uniform.type;
    const int columns = type.starts_with("mat") ? type.back() - '0' : 1;
    sum += columns * std::max(uniform.size, 1);
  }
  return sum;
}

}  // namespace

std::string declared(const Uniforms& uniforms) {
  std::string text;
  for (const Uniform& uniform : uniforms) text.append(declaration("uniform", "u_", uniform));
  return text;
}

std::string handed_on(const Uniforms& uniforms) {
  std::string text = declared(uniforms), copies;
  for (const Uniform& uniform : uniforms) {
    const std::string name = uniform.name;
    text.append(declaration("flat out", "v_", uniform));
    copies.append("  v_").append(name).append(" = u_").append(name).append(";\n");
  }
  return text.append("void hand_on() {\n").append(copies).append("}\n");
}

std::string received(const Uniforms& uniforms) {
  std::string text;
  for (const Uniform& uniform : uniforms) {
    const std::string name = uniform.name;
    text.append(declaration("flat in", "v_", uniform));
    text.append("#define u_").append(name).append(" v_").append(name).append("\n");
  }
  return text;
}

Uniforms distant_light_uniforms(const LightCount& lights) {
  Uniforms uniforms = {{"float", "ambient"}};
  if (lights.directional > 0) {
    uniforms.push_back({"vec3", "beam", lights.directional});       // unit vector in W
    uniforms.push_back({"vec2", "intensity", lights.directional});  // ambient, diffuse
  }
  return uniforms;
}

Uniforms lamp_uniforms(const LightCount& lights) {
  if (lights.lamps == 0) return {};
  return {{"vec3", "lamp_position", lights.lamps},    // W
          {"vec4", "lamp_axis", lights.lamps},        // beam in W; w = cosine of the cut-off angle
          {"vec4", "lamp_falloff", lights.lamps},     // attenuation 1, d, d^2; w = spot exponent
          {"vec2", "lamp_intensity", lights.lamps}};  // ambient, diffuse
}

FragmentUniforms with_lights(Uniforms own, const Uniforms& lights) {
  if (inputs(own) + inputs(lights) > kMostInputs) return {std::move(own), lights};
  own.insert(own.end(), lights.begin(), lights.end());
  return {std::move(own), {}};
}

}  // namespace dodgesim::glsl
