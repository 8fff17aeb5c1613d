#include "sim/render/shaders.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

constexpr const char* kVersion = "#version 330 core\n";

// Diffuse light on a surface point, in units of a white surface under full light. Directional
// lights and the ambient depend on the normal alone: flat faces get them once per vertex.
constexpr const char* kDistantLight = R"(
uniform float u_ambient;
#if DIRECTIONAL > 0
uniform vec3 u_beam[DIRECTIONAL];       // unit vector in W
uniform vec2 u_intensity[DIRECTIONAL];  // ambient, diffuse
#endif
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
uniform vec3 u_lamp_position[LAMPS];   // W
uniform vec4 u_lamp_axis[LAMPS];       // beam in W; w = cosine of the cut-off angle
uniform vec4 u_lamp_falloff[LAMPS];    // attenuation 1, d, d^2; w = spot exponent
uniform vec2 u_lamp_intensity[LAMPS];  // ambient, diffuse
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
float texel(vec3 t) { return texture(u_texture, t.xy).r; }
#elif TEXTURE == 2
uniform samplerCube u_texture;
float texel(vec3 t) { return texture(u_texture, t).r; }
#else
float texel(vec3 t) { return 1.0; }
#endif
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
uniform int u_id;
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

// A rectangle of the image.
constexpr const char* kPrimitiveVertex = R"(
uniform vec4 u_rectangle;  // clip coordinates x0, y0, x1, y1
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(mix(u_rectangle.xy, u_rectangle.zw, corner), 0.0, 1.0);
}
)";

constexpr const char* kPrimitiveCommon = R"(
uniform vec3 u_camera;      // f, cx, cy [px]
uniform vec2 u_depth;       // depth buffer value = u_depth.x + u_depth.y / z_C
uniform mat3 u_R_GC;
uniform vec3 u_eye_G;       // camera centre in the geom's frame
uniform mat4 u_X_WG;
uniform vec3 u_size;
uniform vec3 u_texture_scale;
uniform vec3 u_texture_offset;
uniform vec2 u_albedo_emission;
uniform int u_id;
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

constexpr const char* kHalfPlane = R"(
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

// The outline of an ellipsoid, and that of an endless cylinder, is a conic: the zero set of a
// quadratic form in pixel coordinates.
constexpr const char* kConic = R"(
uniform mat3 u_conic;        // quadratic form in (x - origin.x, y - origin.y, 1), positive inside
uniform vec2 u_conic_origin; // [px]

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
  // Straight pieces a quarter of a pixel long follow also a small, strongly bent outline.
  const int kPieces = 4;
  const float kFar = 1.0;  // [px], more than half a pixel's diagonal
  int pieces = abs(s) > kFar ? 0 : kPieces * kPieces;
  float sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    vec2 offset = (vec2(i % kPieces, i / kPieces) + 0.5) / float(kPieces) - 0.5;
    float s_piece = conic_distance(at + offset, n);
    sum += half_plane_coverage(s_piece, n, 1.0 / float(kPieces));
  }
  if (pieces == 0) return s > 0.0 ? 1.0 : 0.0;
  return sum / float(kPieces * kPieces);
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
uniform float u_margin;  // [m]

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

// One instance an edge: the edge in the image, and a strip a pixel wide on either side.
constexpr const char* kEdgeVertex = R"(
layout(location = 0) in vec3 end_a;
layout(location = 1) in vec3 end_b;
layout(location = 2) in float inside;
uniform mat4 u_X_CW;
uniform vec3 u_camera;   // f, cx, cy [px]
uniform vec2 u_image;    // width, height [px]
uniform float u_near;    // [m]
flat out vec3 line;      // (n, c): signed distance of pixel p is n.p - c
flat out vec4 along;     // unit direction u and u.a [px], length [px]
flat out vec2 inverse_z; // at the ends [1/m]
flat out float crease;   // 1: both faces are in sight
void main() {
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
  crease = inside;
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
flat in float crease;
uniform vec2 u_depth;  // depth buffer value = u_depth.x + u_depth.y / z_C
uniform sampler2D u_luminance;
uniform sampler2D u_depth_image;
layout(location = 0) out vec4 luminance;

float inverse_depth(ivec2 p) {
  p = clamp(p, ivec2(0), textureSize(u_depth_image, 0) - 1);
  return (texelFetch(u_depth_image, p, 0).r - u_depth.x) / u_depth.y;
}

// Whether the face at pixel p, which goes on to the next pixel away from the edge, can have the
// edge: 1/z is linear over a flat face.
bool touches(float edge, float at, float next) {
  return abs(edge - at) < min(1.5 * abs(at - next), 0.05 * edge) + 0.001 * edge;
}

void main() {
  vec2 pixel = gl_FragCoord.xy - 0.5;
  float s = dot(line.xy, pixel) - line.z;
  float beyond = 1.0 - half_plane_coverage(abs(s), line.xy, 1.0);
  ivec2 own = ivec2(gl_FragCoord.xy);
  vec2 over = s > 0.0 ? -line.xy : line.xy;
  ivec2 step = abs(over.x) > abs(over.y) ? ivec2(sign(over.x), 0) : ivec2(0, sign(over.y));
  float t = (dot(along.xy, pixel) - along.z) / along.w;
  bool within = t >= 0.0 && t < 1.0;  // a pixel belongs to one piece of a bent outline
  float edge = mix(inverse_z.x, inverse_z.y, t);
  bool here = touches(edge, inverse_depth(own), inverse_depth(own - step));
  bool there = touches(edge, inverse_depth(own + step), inverse_depth(own + 2 * step));
  bool seen = crease > 0.5 ? here && there : here || there;
  if (!seen || !within || beyond <= 0.0) discard;
  ivec2 other = clamp(own + step, ivec2(0), textureSize(u_luminance, 0) - 1);
  luminance = vec4(texelFetch(u_luminance, other, 0).r, 0.0, 0.0, beyond);
}
)";

constexpr const char* kSkyVertex = R"(
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * corner - 1.0, 1.0, 1.0);  // on the far plane
}
)";

// MuJoCo turns the sky by 90 degrees about x, so that the cube's +y face is overhead.
constexpr const char* kSkyFragment = R"(
uniform vec3 u_camera;  // f, cx, cy [px]
uniform mat3 u_R_WC;
uniform float u_sky_luminance;
layout(location = 0) out vec4 luminance;
layout(location = 1) out int id;
void main() {
  vec2 pixel = gl_FragCoord.xy - 0.5;
  vec3 d = u_R_WC * vec3((pixel - u_camera.yz) / u_camera.x, 1.0);
  luminance = vec4(u_sky_luminance * texel(vec3(d.x, d.z, -d.y)), 0.0, 0.0, 1.0);
  id = -1;
}
)";

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

GLuint compile(GLenum stage, const std::string& source) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    char message[2000] = "";
    glGetShaderInfoLog(shader, sizeof message, nullptr, message);
    throw SimulationError(std::string("A shader of the renderer does not compile: ") + message);
  }
  return shader;
}

}  // namespace

std::string triangle_vertex_shader(const LightCount& lights) {
  return header(TextureKind::kNone, lights) + kDistantLight + kTriangleVertex;
}

std::string triangle_fragment_shader(TextureKind texture, const LightCount& lights) {
  return header(texture, lights) + kLamps + kTexel + kTriangleFragment;
}

std::string primitive_vertex_shader() { return std::string(kVersion) + kPrimitiveVertex; }

std::string primitive_fragment_shader(mjtGeom type, TextureKind texture, const LightCount& lights,
                                      bool hard) {
  const std::string common = header(texture, lights) +
                             (hard ? "#define HARD 1\n" : "#define HARD 0\n") + kDistantLight +
                             kLamps + kTexel + kPrimitiveCommon;
  switch (type) {
    case mjGEOM_ELLIPSOID:
      return common + kHalfPlane + kConic + kEllipsoid;
    case mjGEOM_CAPSULE:
      return common + kHalfPlane + kConic + kRoundSide + kCapsule + kSampled;
    case mjGEOM_CYLINDER:
      return common + kHalfPlane + kConic + kRoundSide + kCylinder + kSampled;
    default:
      return common + kBox + kSampled;
  }
}

std::string sky_vertex_shader() { return std::string(kVersion) + kSkyVertex; }

std::string sky_fragment_shader(TextureKind texture) {
  return header(texture, {}) + kTexel + kSkyFragment;
}

std::string edge_vertex_shader() { return std::string(kVersion) + kEdgeVertex; }

std::string edge_fragment_shader() { return std::string(kVersion) + kHalfPlane + kEdgeFragment; }

unsigned link_program(const std::string& vertex, const std::string& fragment) {
  const GLuint program = glCreateProgram();
  const GLuint shaders[] = {compile(GL_VERTEX_SHADER, vertex),
                            compile(GL_FRAGMENT_SHADER, fragment)};
  for (const GLuint shader : shaders) {
    glAttachShader(program, shader);
    glDeleteShader(shader);  // lives on with the program
  }
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) {
    char message[2000] = "";
    glGetProgramInfoLog(program, sizeof message, nullptr, message);
    throw SimulationError(std::string("A shader of the renderer does not link: ") + message);
  }
  return program;
}

}  // namespace dodgesim
