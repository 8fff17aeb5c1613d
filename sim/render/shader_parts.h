// Pieces of GLSL that several shaders of the renderer share.
#pragma once

#include <string>

#include "sim/render/shaders.h"

namespace dodgesim::glsl {

inline constexpr const char* kVersion = "#version 330 core\n";

// The version and the macros TEXTURE (0 none, 1 2-D, 2 cube), DIRECTIONAL and LAMPS (numbers of
// lights).
std::string header(TextureKind texture, const LightCount& lights);

// Diffuse light on a surface point, in units of a white surface under full light. Directional
// lights and the ambient depend on the normal alone: flat faces get them once per vertex.
// Uniforms: distant_light_uniforms(), lamp_uniforms() and, of kTexel, u_lod_bias.
inline constexpr const char* kDistantLight = R"(
float distant_light(vec3 n_W) {
  float sum = u_ambient;
#if DIRECTIONAL > 0
  for (int i = 0; i < DIRECTIONAL; ++i) {
    sum += u_intensity[i].x + u_intensity[i].y * max(0.0, -dot(n_W, u_beam[i]));
  }
#endif
  return sum;
}
)";

inline constexpr const char* kLamps = R"(
#if LAMPS > 0
float lamp_light(vec3 p_W, vec3 n_W) {
  float sum = 0.0;
  for (int i = 0; i < LAMPS; ++i) {
    vec3 ray = p_W - u_lamp_position[i];
    float d = length(ray);
    ray /= d;
    vec4 falloff = u_lamp_falloff[i];
    float strength = 1.0 / (falloff.x + d * (falloff.y + d * falloff.z));
    float c = dot(ray, u_lamp_axis[i].xyz);
    if (c < u_lamp_axis[i].w) strength = 0.0;
    else if (falloff.w != 0.0) strength *= pow(max(c, 0.0), falloff.w);
    sum += strength * (u_lamp_intensity[i].x + u_lamp_intensity[i].y * max(0.0, -dot(n_W, ray)));
  }
  return sum;
}
#else
float lamp_light(vec3 p_W, vec3 n_W) { return 0.0; }
#endif
)";

inline constexpr const char* kTexel = R"(
#if TEXTURE == 1
uniform sampler2D u_texture;
float texel(vec3 t) { return texture(u_texture, t.xy, u_lod_bias).r; }
#elif TEXTURE == 2
uniform samplerCube u_texture;
float texel(vec3 t) { return texture(u_texture, t, u_lod_bias).r; }
#else
float texel(vec3 t) { return 1.0; }
#endif
)";

inline constexpr const char* kHalfPlane = R"(
// Part of a square of the given width that lies on the inner side of a line at the signed distance
// s from its centre (positive: centre inside); n: unit normal of the line.
float half_plane_coverage(float s, vec2 n, float width) {
  float a = max(abs(n.x), abs(n.y)), b = min(abs(n.x), abs(n.y));
  float d = abs(s) / width;
  float h = 0.5 * (a + b);
  float outside;  // part beyond the line, away from the centre
  if (d >= h) outside = 0.0;
  else if (d <= 0.5 * (a - b)) outside = 0.5 - d / a;
  else outside = (h - d) * (h - d) / (2.0 * a * b);
  return s >= 0.0 ? 1.0 - outside : outside;
}
)";

}  // namespace dodgesim::glsl
