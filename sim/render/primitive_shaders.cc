// Shaders of the ray-cast solids.
#include "sim/render/shader_parts.h"
#include "sim/render/uniforms.h"

namespace dodgesim {

namespace {

// A rectangle of the image.
constexpr const char* kPrimitiveVertex = R"(
uniform vec4 u_rectangle;  // clip coordinates x0, y0, x1, y1
void main() {
  hand_on();
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(mix(u_rectangle.xy, u_rectangle.zw, corner), 0.0, 1.0);
}
)";

constexpr const char* kPrimitiveCommon = R"(
layout(location = 0) out vec4 luminance;
layout(location = 1) out int id;

vec3 ray_G(vec2 pixel) { return u_R_GC * vec3((pixel - u_camera.yz) / u_camera.x, 1.0); }

float shade(vec3 p_G, vec3 n_G) {
  vec3 n_W = mat3(u_X_WG) * n_G;
  float light = u_albedo_emission.x *
                (distant_light(n_W) + lamp_light((u_X_WG * vec4(p_G, 1.0)).xyz, n_W)) +
                u_albedo_emission.y;
  return light * texel(p_G * u_texture_scale + u_texture_offset);
}

// llvmpipe computes both sides of every branch; only loops end early. Hence the loops below that run
// 0 or n times.

// The ray's parameter is its depth z_C, because ray_G has z_C = 1.
void write(float value, float coverage, float z_C) {
  luminance = vec4(value, 0.0, 0.0, coverage);
  id = u_id;
  gl_FragDepth = clamp(u_depth.x + u_depth.y / z_C, 0.0, 1.0);
}
)";

// The outline of an ellipsoid, and that of an endless cylinder, is a conic: the zero set of a
// quadratic form in pixel coordinates.
constexpr const char* kConic = R"(
// Distance to the conic along its gradient, exact for the quadratic form; positive inside.
float conic_distance(vec2 at, out vec2 n) {
  vec3 q = u_conic * vec3(at, 1.0);
  float g = dot(q, vec3(at, 1.0));
  vec2 gradient = 2.0 * q.xy;
  float steepness = length(gradient);
  n = steepness > 0.0 ? gradient / steepness : vec2(1.0, 0.0);
  float curvature = 2.0 * dot(n, mat2(u_conic) * n);
  float root = sqrt(max(steepness * steepness - 2.0 * curvature * g, 0.0));
  return 2.0 * g / max(steepness + root, 1e-30);
}

// Of the pixel at `at`, relative to the origin of the conic.
float conic_coverage(vec2 at) {
  vec2 n;
  float s = conic_distance(at, n);
  // In each of u_pieces x u_pieces parts of the pixel the outline is taken as straight.
  const float kFar = 1.0;  // [px], more than half a pixel's diagonal
  int parts = abs(s) > kFar ? 0 : u_pieces * u_pieces;
  float width = 1.0 / float(u_pieces), first = 0.5 * width - 0.5, sum = 0.0;
  vec2 offset = vec2(first);
  for (int i = 0; i < parts; ++i) {
    float s_part = conic_distance(at + offset, n);
    sum += half_plane_coverage(s_part, n, width);
    offset.x += width;
    if (offset.x > 0.5) offset = vec2(first, offset.y + width);
  }
  if (parts == 0) return s > 0.0 ? 1.0 : 0.0;
  return sum / float(parts);
}
)";

constexpr const char* kEllipsoid = R"(
void main() {
  vec2 pixel = gl_FragCoord.xy - 0.5;
  vec3 d = ray_G(pixel) / u_size;
  vec3 eye = u_eye_G / u_size;
  float a = dot(d, d), b = dot(eye, d);
  vec3 moment = cross(eye, d);
  float square = a - dot(moment, moment);  // well conditioned far away
  float t = (-b - sqrt(max(square, 0.0))) / a;  // a ray that misses: its closest approach
#if HARD
  float coverage = square >= 0.0 ? 1.0 : 0.0, value = 0.0;
#else
  float coverage = conic_coverage(pixel - u_conic_origin);
  vec3 on_unit = eye + t * d;
  float value = shade(on_unit * u_size, normalize(on_unit / u_size));
#endif
  if (coverage == 0.0 || t <= 0.0) discard;
  write(value, coverage, t);
}
)";

// Solids with several faces. intersect(): whether a ray hits the solid of the given size, where and
// on which face. Part of the pixel covered by each face: all of it if centre and corners hit one
// face, none if the ray misses a slightly larger solid, else analytic where the pixel sees only the
// round side of the solid, else counted with 64 rays, no two of which share a column or a row.
constexpr const char* kSampled = R"(
#if HARD
void main() {
  float t;
  int face;
  if (!intersect(ray_G(gl_FragCoord.xy - 0.5), u_size, t, face)) discard;
  write(0.0, 1.0, t);
}
#else
vec3 face_coverage(vec2 pixel, out float t) {
  vec3 count = vec3(0.0);
  float t_ray;
  int face, face_ray;
  bool close = intersect(ray_G(pixel), u_size + u_margin, t, face);
  bool center_hit = intersect(ray_G(pixel), u_size, t, face);
  bool one_face = center_hit;
  bool side_only = false;
#ifdef ROUND_SIDE
  on_side(ray_G(pixel), t_ray);
  if (!center_hit) t = t_ray;
  side_only = close;
#endif
  int corners = close ? 4 : 0;
  for (int i = 0; i < corners; ++i) {
    vec3 corner = ray_G(pixel + vec2(i & 1, i >> 1) - 0.5);
    one_face = intersect(corner, u_size, t_ray, face_ray) && face_ray == face && one_face;
#ifdef ROUND_SIDE
    side_only = on_side(corner, t_ray) && side_only;
#endif
  }
  if (one_face) count[face] = 1.0;
#ifdef ROUND_SIDE
  float side = conic_coverage(pixel - u_conic_origin);
  if (side_only && !one_face) count[0] = side;
#endif
  const int kRays = 64;
  int rays = close && !one_face && !side_only ? kRays : 0;
  for (int i = 0; i < rays; ++i) {
    int r = ((i & 1) << 5) | ((i & 2) << 3) | ((i & 4) << 1) | ((i & 8) >> 1) | ((i & 16) >> 3) |
            ((i & 32) >> 5);
    vec2 offset = (vec2(i, r) + 0.5) / float(kRays) - 0.5;
    if (intersect(ray_G(pixel + offset), u_size, t_ray, face_ray)) {
      count[face_ray] += 1.0 / float(kRays);
      if (!center_hit) t = t_ray;
    }
  }
  return count;
}

void main() {
  vec2 pixel = gl_FragCoord.xy - 0.5;
  vec3 center = ray_G(pixel);
  float t;
  vec3 count = face_coverage(pixel, t);
  float coverage = count.x + count.y + count.z;
  float value = 0.0;
  for (int k = 0; k < FACES; ++k) value += count[k] * shade_face(center, k);
  if (coverage == 0.0) discard;
  write(value / coverage, coverage, t);
}
#endif
)";

constexpr const char* kBox = R"(
#define FACES 3
bool intersect(vec3 d, vec3 size, out float t, out int face) {
  vec3 entry = (-sign(d) * size - u_eye_G) / d;
  vec3 leave = (sign(d) * size - u_eye_G) / d;
  t = max(entry.x, max(entry.y, entry.z));
  face = t == entry.x ? 0 : (t == entry.y ? 1 : 2);
  return t > 0.0 && t <= min(leave.x, min(leave.y, leave.z));
}
// The face seen across axis k; its plane is extended beyond its edges.
float shade_face(vec3 d, int k) {
  float side = sign(u_eye_G[k]);
  vec3 p = u_eye_G + (side * u_size[k] - u_eye_G[k]) / d[k] * d;
  vec3 n = vec3(0.0);
  n[k] = side;
  return shade(clamp(p, -u_size, u_size), n);
}
)";

// Squared sine of the angle between ray and axis, times |d|^2; never 0.
constexpr const char* kRoundSide = R"(
#define ROUND_SIDE
float across(vec3 d) { return max(dot(d.xy, d.xy), 1e-12 * dot(d, d)); }
// Positive where the ray hits the endless cylinder of that radius around z.
float reach(vec3 d, float radius) {
  float moment = u_eye_G.x * d.y - u_eye_G.y * d.x;
  return radius * radius * across(d) - moment * moment;
}
// Whether the ray meets, or passes closest to, the round side between its ends, and where.
bool on_side(vec3 d, out float t) {
  t = (-dot(u_eye_G.xy, d.xy) - sqrt(max(reach(d, u_size.x), 0.0))) / across(d);
  return t > 0.0 && abs(u_eye_G.z + t * d.z) <= u_size.z;
}
)";

constexpr const char* kCylinder = R"(
#define FACES 2
bool intersect(vec3 d, vec3 size, out float t, out int face) {
  float a = across(d), b = dot(u_eye_G.xy, d.xy), square = reach(d, size.x);
  t = 0.0;
  face = 0;
  if (square < 0.0) return false;
  float root = sqrt(square);
  float cap_entry = (-sign(d.z) * size.z - u_eye_G.z) / d.z;
  float cap_leave = (sign(d.z) * size.z - u_eye_G.z) / d.z;
  t = max((-b - root) / a, cap_entry);
  face = t == cap_entry ? 1 : 0;
  return t > 0.0 && t <= min((-b + root) / a, cap_leave);
}
// The side or the cap towards the camera, extended beyond its edge.
float shade_face(vec3 d, int k) {
  if (k == 1) {
    float side = sign(u_eye_G.z);
    vec3 p = u_eye_G + (side * u_size.z - u_eye_G.z) / d.z * d;
    return shade(p, vec3(0.0, 0.0, side));
  }
  float root = sqrt(max(reach(d, u_size.x), 0.0));
  vec3 p = u_eye_G + (-dot(u_eye_G.xy, d.xy) - root) / across(d) * d;
  p.z = clamp(p.z, -u_size.z, u_size.z);
  return shade(p, vec3(normalize(p.xy), 0.0));
}
)";

constexpr const char* kCapsule = R"(
#define FACES 1
bool sphere_entry(vec3 d, float height, float radius, out float t) {
  vec3 e = u_eye_G - vec3(0.0, 0.0, height);
  vec3 m = cross(e, d);
  float a = dot(d, d), square = radius * radius * a - dot(m, m);
  t = (-dot(e, d) - sqrt(max(square, 0.0))) / a;
  return square >= 0.0;
}
// Also for a ray that passes close by: then at its closest approach.
bool entry(vec3 d, vec3 size, out float t) {
  float square = reach(d, size.x);
  t = (-dot(u_eye_G.xy, d.xy) - sqrt(max(square, 0.0))) / across(d);
  float z = u_eye_G.z + t * d.z;
  // The margin of a larger solid is in its radius alone.
  if (abs(z) > u_size.z) return sphere_entry(d, sign(z) * u_size.z, size.x, t);
  return square >= 0.0;
}
bool intersect(vec3 d, vec3 size, out float t, out int face) {
  face = 0;
  return entry(d, size, t) && t > 0.0;
}
float shade_face(vec3 d, int k) {
  float t;
  entry(d, u_size, t);
  vec3 p = u_eye_G + t * d;
  return shade(p, normalize(p - vec3(0.0, 0.0, clamp(p.z, -u_size.z, u_size.z))));
}
)";

// Of the fragments. A compiler drops what its solid has no use for.
const glsl::Uniforms kUniforms = {
    {"vec3", "camera"},  // f, cx, cy [px]
    {"vec2", "depth"},   // depth buffer value = u_depth.x + u_depth.y / z_C
    {"mat3", "R_GC"},
    {"vec3", "eye_G"},  // camera centre in the geom's frame
    {"mat4", "X_WG"},
    {"vec3", "size"},
    {"float", "margin"},       // [m]
    {"mat3", "conic"},         // quadratic form in (x - origin.x, y - origin.y, 1), positive inside
    {"vec2", "conic_origin"},  // [px]
    {"int", "pieces"},         // along a pixel's side, in which the outline is taken as straight
    {"vec3", "texture_scale"},
    {"vec3", "texture_offset"},
    {"float", "lod_bias"},
    {"vec2", "albedo_emission"},
    {"int", "id"},
};

glsl::FragmentUniforms uniforms_with(const LightCount& lights) {
  glsl::Uniforms of_lights = glsl::distant_light_uniforms(lights);
  const glsl::Uniforms lamps = glsl::lamp_uniforms(lights);
  of_lights.insert(of_lights.end(), lamps.begin(), lamps.end());
  return glsl::with_lights(kUniforms, of_lights);
}

}  // namespace

std::string primitive_vertex_shader(const LightCount& lights) {
  return std::string(glsl::kVersion) + glsl::handed_on(uniforms_with(lights).handed_on) +
         kPrimitiveVertex;
}

std::string primitive_fragment_shader(mjtGeom type, TextureKind texture, const LightCount& lights,
                                      bool hard) {
  const glsl::FragmentUniforms uniforms = uniforms_with(lights);
  const std::string common =
      glsl::header(texture, lights) + (hard ? "#define HARD 1\n" : "#define HARD 0\n") +
      glsl::received(uniforms.handed_on) + glsl::declared(uniforms.declared) + glsl::kDistantLight +
      glsl::kLamps + glsl::kTexel + kPrimitiveCommon;
  switch (type) {
    case mjGEOM_ELLIPSOID:
      return common + glsl::kHalfPlane + kConic + kEllipsoid;
    case mjGEOM_CAPSULE:
      return common + glsl::kHalfPlane + kConic + kRoundSide + kCapsule + kSampled;
    case mjGEOM_CYLINDER:
      return common + glsl::kHalfPlane + kConic + kRoundSide + kCylinder + kSampled;
    default:
      return common + kBox + kSampled;
  }
}

}  // namespace dodgesim
