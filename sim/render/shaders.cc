#include "sim/render/shaders.h"

#include "sim/render/uniforms.h"

namespace dodgesim {

namespace {

constexpr const char* kVersion = "#version 330 core\n";

// Diffuse light on a surface point, in units of a white surface under full light. Directional
// lights and the ambient depend on the normal alone: flat faces get them once per vertex.
// Uniforms: distant_light_uniforms(), lamp_uniforms() and, of kTexel, u_lod_bias.
constexpr const char* kDistantLight = R"(
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

constexpr const char* kLamps = R"(
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

constexpr const char* kTexel = R"(
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

constexpr const char* kPartBeyond = R"(
// Part of a pixel that lies beyond a line at the distance d from its centre; n: unit normal of the
// line.
float part_beyond(float d, vec2 n) {
  float a = max(abs(n.x), abs(n.y)), b = min(abs(n.x), abs(n.y));
  float h = 0.5 * (a + b);
  if (d >= h) return 0.0;
  if (d <= 0.5 * (a - b)) return 0.5 - d / a;
  return (h - d) * (h - d) / (2.0 * a * b);
}
)";

constexpr const char* kTriangleVertex = R"(
layout(location = 0) in vec3 position;  // in the frame G of the batch
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 texture_coordinate;
layout(location = 3) in vec2 albedo_emission;
uniform mat4 u_clip_from_G;
uniform mat4 u_X_WG;
uniform vec3 u_texture_shift;
out vec3 texture_at;
out float lit;  // under ambient and distant lights
#if LAMPS > 0
out vec3 p_W;
out vec3 n_W;
flat out float albedo;
#endif
void main() {
  hand_on();
  gl_Position = u_clip_from_G * vec4(position, 1.0);
  vec3 normal_W = mat3(u_X_WG) * normal;
  lit = albedo_emission.x * distant_light(normal_W) + albedo_emission.y;
  texture_at = texture_coordinate + u_texture_shift;
#if LAMPS > 0
  p_W = (u_X_WG * vec4(position, 1.0)).xyz;
  n_W = normal_W;
  albedo = albedo_emission.x;
#endif
}
)";

constexpr const char* kTriangleFragment = R"(
in vec3 texture_at;
in float lit;
#if LAMPS > 0
in vec3 p_W;
in vec3 n_W;
flat in float albedo;
#endif
layout(location = 0) out vec4 luminance;
layout(location = 1) out int id;
void main() {
  float light = lit;
#if LAMPS > 0
  light += albedo * lamp_light(p_W, normalize(n_W));
#endif
  luminance = vec4(texel(texture_at) * light, 0.0, 0.0, 1.0);
  id = u_id;
}
)";

// One instance an edge: the edge in the image, and a strip a pixel wide on either side.
constexpr const char* kEdgeVertex = R"(
layout(location = 0) in vec3 end_a;
layout(location = 1) in vec3 end_b;
layout(location = 2) in vec2 inside_bulge;
uniform mat4 u_X_CW;
uniform vec3 u_camera;   // f, cx, cy [px]
uniform vec2 u_image;    // width, height [px]
uniform float u_near;    // [m]
flat out vec3 line;      // (n, c): signed distance of pixel p is n.p - c
flat out vec4 along;     // unit direction u and u.a [px], length [px]
flat out vec2 inverse_z; // at the ends [1/m]
flat out vec2 crease_bulge; // 1: both faces are in sight; bulge [m]
void main() {
  hand_on();
  vec3 a = (u_X_CW * vec4(end_a, 1.0)).xyz, b = (u_X_CW * vec4(end_b, 1.0)).xyz;
  gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside: not drawn
  if (max(a.z, b.z) <= u_near) return;
  if (a.z < u_near) a = mix(a, b, (u_near - a.z) / (b.z - a.z));
  if (b.z < u_near) b = mix(b, a, (u_near - b.z) / (a.z - b.z));
  vec2 p = u_camera.x * a.xy / a.z + u_camera.yz, q = u_camera.x * b.xy / b.z + u_camera.yz;
  float size = distance(p, q);
  if (size < 1e-3) return;
  vec2 u = (q - p) / size, n = vec2(-u.y, u.x);
  line = vec3(n, dot(n, p));
  along = vec4(u, dot(u, p), size);
  inverse_z = 1.0 / vec2(a.z, b.z);
  crease_bulge = inside_bulge;
  vec2 corner = mix(p - 0.1 * u, q + 0.1 * u, float(gl_VertexID & 1)) +
                (gl_VertexID < 2 ? -0.75 : 0.75) * n;
  gl_Position = vec4(2.0 * (corner + 0.5) / u_image - 1.0, 0.0, 1.0);
}
)";

// A pixel that the edge crosses gets its neighbour's luminance for the part beyond the edge. Depths
// at and beyond both pixels tell whether the edge is in sight here.
constexpr const char* kEdgeFragment = R"(
flat in vec3 line;
flat in vec4 along;
flat in vec2 inverse_z;
flat in vec2 crease_bulge;
uniform sampler2D u_luminance;
uniform sampler2D u_depth_image;
layout(location = 0) out vec4 luminance;

float luminance_at(ivec2 p) {
  return texelFetch(u_luminance, clamp(p, ivec2(0), textureSize(u_luminance, 0) - 1), 0).r;
}

float inverse_depth(ivec2 p) {
  p = clamp(p, ivec2(0), textureSize(u_depth_image, 0) - 1);
  return (texelFetch(u_depth_image, p, 0).r - u_depth.x) / u_depth.y;
}

// Whether the face at pixel p, which goes on to the next pixel away from the edge, can have the
// edge: 1/z is linear over a flat face; a round one comes nearer.
bool touches(float edge, float at, float next) {
  float slack = min(1.5 * abs(at - next), 0.05 * edge) + 0.001 * edge;
  return abs(edge - at) < slack || (at > edge && at - edge < crease_bulge.y * edge * at);
}

void main() {
  vec2 pixel = gl_FragCoord.xy - 0.5;
  float s = dot(line.xy, pixel) - line.z;
  float beyond = part_beyond(abs(s), line.xy);
  ivec2 own = ivec2(gl_FragCoord.xy);
  vec2 over = s > 0.0 ? -line.xy : line.xy;
  ivec2 step = abs(over.x) > abs(over.y) ? ivec2(sign(over.x), 0) : ivec2(0, sign(over.y));
  float t = (dot(along.xy, pixel) - along.z) / along.w;
  bool within = t >= 0.0 && t < 1.0;  // a pixel belongs to one piece of a bent outline
  float edge = mix(inverse_z.x, inverse_z.y, t);
  // The rasteriser rounds positions to 1/256 px: about a centre on the edge one cannot tell which
  // side was drawn, and the neighbours on both sides stand for it.
  bool undecided = abs(s) < 1.0 / 128.0;
  ivec2 mine = undecided ? own - step : own;
  bool here = touches(edge, inverse_depth(mine), inverse_depth(mine - step));
  bool there = touches(edge, inverse_depth(own + step), inverse_depth(own + 2 * step));
  bool seen = crease_bulge.x > 0.5 ? here && there : here || there;
  if (!seen || !within || beyond <= 0.0) discard;
  float other = luminance_at(own + step);
  luminance = undecided ? vec4(mix(luminance_at(mine), other, beyond), 0.0, 0.0, 1.0)
                        : vec4(other, 0.0, 0.0, beyond);
}
)";

constexpr const char* kSkyVertex = R"(
void main() {
  hand_on();
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * corner - 1.0, 1.0, 1.0);  // on the far plane
}
)";

// MuJoCo turns the sky by 90 degrees about x, so that the cube's +y face is overhead.
constexpr const char* kSkyFragment = R"(
layout(location = 0) out vec4 luminance;
layout(location = 1) out int id;
void main() {
  vec2 pixel = gl_FragCoord.xy - 0.5;
  vec3 d = u_R_WC * vec3((pixel - u_camera.yz) / u_camera.x, 1.0);
  luminance = vec4(u_sky_luminance * texel(vec3(d.x, d.z, -d.y)), 0.0, 0.0, 1.0);
  id = -1;
}
)";

// Of the fragments.
const glsl::Uniforms kEdgeUniforms = {
    {"vec2", "depth"},  // depth buffer value = u_depth.x + u_depth.y / z_C
};
const glsl::Uniforms kSkyUniforms = {
    {"vec3", "camera"},  // f, cx, cy [px]
    {"mat3", "R_WC"},
    {"float", "sky_luminance"},
    {"float", "lod_bias"},
};

// The version and the macros TEXTURE (0 none, 1 2-D, 2 cube), DIRECTIONAL and LAMPS (numbers of
// lights).
std::string header(TextureKind texture, const LightCount& lights) {
  std::string text = kVersion;
  const auto define = [&text](const char* name, int value) {
    text.append("#define ").append(name).append(" ").append(std::to_string(value)).append("\n");
  };
  define("TEXTURE", static_cast<int>(texture));
  define("DIRECTIONAL", lights.directional);
  define("LAMPS", lights.lamps);
  return text;
}

glsl::FragmentUniforms triangle_uniforms(const LightCount& lights) {
  return glsl::with_lights({{"int", "id"}, {"float", "lod_bias"}}, glsl::lamp_uniforms(lights));
}

}  // namespace

std::string triangle_vertex_shader(const LightCount& lights) {
  return header(TextureKind::kNone, lights) + glsl::declared(glsl::distant_light_uniforms(lights)) +
         glsl::handed_on(triangle_uniforms(lights).handed_on) + kDistantLight + kTriangleVertex;
}

std::string triangle_fragment_shader(TextureKind texture, const LightCount& lights) {
  const glsl::FragmentUniforms uniforms = triangle_uniforms(lights);
  return header(texture, lights) + glsl::received(uniforms.handed_on) +
         glsl::declared(uniforms.declared) + kLamps + kTexel + kTriangleFragment;
}

std::string sky_vertex_shader() {
  return std::string(kVersion) + glsl::handed_on(kSkyUniforms) + kSkyVertex;
}

std::string sky_fragment_shader(TextureKind texture) {
  return header(texture, {}) + glsl::received(kSkyUniforms) + kTexel + kSkyFragment;
}

std::string edge_vertex_shader() {
  return std::string(kVersion) + glsl::handed_on(kEdgeUniforms) + kEdgeVertex;
}

std::string edge_fragment_shader() {
  return std::string(kVersion) + glsl::received(kEdgeUniforms) + kPartBeyond + kEdgeFragment;
}

}  // namespace dodgesim
