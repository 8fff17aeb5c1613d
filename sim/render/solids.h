// Rays against the convex solids that are ray-cast. Straight code without branches, so that loops
// over pixels are vectorised. Frame G of the geom, single precision.
#pragma once

#include <cmath>

#include "sim/base/branchless.h"

#define DODGESIM_INLINE [[gnu::always_inline]] inline

namespace dodgesim {

struct Vec3 {
  float x, y, z;
};

// How a camera sees a solid: primitive_view.h in single precision.
struct SolidView {
  float inverse_f, cx, cy;    // of the camera [1/px, px, px]
  Vec3 right, down, forward;  // the camera's axes in G
  Vec3 eye;                   // the camera's centre in G [m]
  Vec3 size;                  // half axes, or radius, radius, half length [m]
  float margin;               // a ray that misses by more leaves its pixel uncovered [m]
  float conic[9];             // row-major; see PrimitiveView
  float conic_x, conic_y;     // origin of the conic [px]
  int pieces;                 // along a pixel's side
};

namespace solid {

DODGESIM_INLINE Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
DODGESIM_INLINE Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
DODGESIM_INLINE Vec3 operator*(float s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
DODGESIM_INLINE Vec3 times(const Vec3& a, const Vec3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
DODGESIM_INLINE Vec3 over(const Vec3& a, const Vec3& b) {
  return {a.x / b.x, a.y / b.y, a.z / b.z};
}
DODGESIM_INLINE Vec3 inverse(const Vec3& a) { return {1.0f / a.x, 1.0f / a.y, 1.0f / a.z}; }
DODGESIM_INLINE float dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
DODGESIM_INLINE Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
DODGESIM_INLINE Vec3 normalized(const Vec3& a) { return (1.0f / std::sqrt(dot(a, a))) * a; }
DODGESIM_INLINE float root_of(float square) { return std::sqrt(larger(square, 0.0f)); }
DODGESIM_INLINE float sign_of(float a) { return std::copysign(1.0f, a); }
DODGESIM_INLINE float within(float a, float limit) { return smaller(larger(a, -limit), limit); }
DODGESIM_INLINE float magnitude(float a) { return std::fabs(a); }

// Of a pixel. Its parameter t is the depth z_C.
DODGESIM_INLINE Vec3 ray(const SolidView& v, float x, float y) {
  return ((x - v.cx) * v.inverse_f) * v.right + ((y - v.cy) * v.inverse_f) * v.down + v.forward;
}

// Where a ray meets a solid of the given size, and which face: -1 if it does not.
struct Entry {
  float t;
  int face;
};

// A point of a face, and the outer normal there.
struct FacePoint {
  float x, y, z, n_x, n_y, n_z;
};
DODGESIM_INLINE FacePoint face_point(const Vec3& p, const Vec3& n) {
  return {p.x, p.y, p.z, n.x, n.y, n.z};
}

// Where a ray meets a quadric: if it does, `square` is not negative; else it passes closest at t.
struct Roots {
  float square, t;
};

// Each solid has entry() and point(): where a ray meets the given face, extended beyond its edges;
// for a round one that the ray misses, where it passes closest.

struct Ellipsoid {
  static constexpr int kFaces = 1;

  // In coordinates in which it is the unit sphere, with the camera at e and the ray along d.
  DODGESIM_INLINE static Roots roots(const Vec3& e, const Vec3& d) {
    const Vec3 moment = cross(e, d);
    const float a = dot(d, d);
    const float square = a - dot(moment, moment);  // well conditioned far away
    return {square, (-dot(e, d) - root_of(square)) / a};
  }
  DODGESIM_INLINE static Entry entry(const SolidView& v, const Vec3& size, const Vec3& d) {
    const Vec3 scale = inverse(size);  // the same for all rays
    const Roots r = roots(times(v.eye, scale), times(d, scale));
    return {r.t, (r.square >= 0.0f) & (r.t > 0.0f) ? 0 : -1};
  }
  DODGESIM_INLINE static FacePoint point(const SolidView& v, int, const Vec3& d) {
    const Vec3 scale = inverse(v.size);
    const Vec3 e = times(v.eye, scale), d_unit = times(d, scale);
    const float t = roots(e, d_unit).t;
    const Vec3 on_unit = e + t * d_unit;
    return face_point(times(on_unit, v.size), normalized(times(on_unit, scale)));
  }
};

struct Box {
  static constexpr int kFaces = 3;

  DODGESIM_INLINE static Entry entry(const SolidView& v, const Vec3& size, const Vec3& d) {
    const Vec3 half = {sign_of(d.x) * size.x, sign_of(d.y) * size.y, sign_of(d.z) * size.z};
    const Vec3 in = over(-1.0f * half - v.eye, d), out = over(half - v.eye, d);
    const float t = larger(in.x, larger(in.y, in.z));
    const float t_out = smaller(out.x, smaller(out.y, out.z));
    const int face = t == in.x ? 0 : (t == in.y ? 1 : 2);
    return {t, (t > 0.0f) & (t <= t_out) ? face : -1};
  }
  DODGESIM_INLINE static FacePoint point(const SolidView& v, int face, const Vec3& d) {
    const bool x = face == 0, y = face == 1;
    const Vec3 side = {sign_of(v.eye.x), sign_of(v.eye.y), sign_of(v.eye.z)};
    const Vec3 to_faces = over(times(side, v.size) - v.eye, d);
    const float t = x ? to_faces.x : (y ? to_faces.y : to_faces.z);
    const Vec3 p = v.eye + t * d;
    return face_point({within(p.x, v.size.x), within(p.y, v.size.y), within(p.z, v.size.z)},
                      {x ? side.x : 0.0f, y ? side.y : 0.0f, x | y ? 0.0f : side.z});
  }
};

// Squared sine of the angle between ray and axis, times |d|^2; never 0.
DODGESIM_INLINE float across(const Vec3& d) {
  return larger(d.x * d.x + d.y * d.y, 1e-12f * dot(d, d));
}
// Positive where the ray hits the endless cylinder of that radius around z.
DODGESIM_INLINE float reach(const SolidView& v, const Vec3& d, float radius) {
  const float moment = v.eye.x * d.y - v.eye.y * d.x;
  return radius * radius * across(d) - moment * moment;
}
DODGESIM_INLINE float towards_axis(const SolidView& v, const Vec3& d) {
  return -(v.eye.x * d.x + v.eye.y * d.y);
}
DODGESIM_INLINE float side_t(const SolidView& v, const Vec3& d, float radius) {
  return (towards_axis(v, d) - root_of(reach(v, d, radius))) / across(d);
}
// Whether the ray meets, or passes closest to, the round side between its ends, and where.
DODGESIM_INLINE Entry side_entry(const SolidView& v, const Vec3& d) {
  const float t = side_t(v, d, v.size.x);
  return {t, (t > 0.0f) & (magnitude(v.eye.z + t * d.z) <= v.size.z) ? 0 : -1};
}

// Face 0 is the side, 1 the cap towards the camera.
struct Cylinder {
  static constexpr int kFaces = 2;

  DODGESIM_INLINE static Entry entry(const SolidView& v, const Vec3& size, const Vec3& d) {
    const float square = reach(v, d, size.x), root = root_of(square), a = across(d);
    const float half = sign_of(d.z) * size.z;
    const float cap_in = (-half - v.eye.z) / d.z, cap_out = (half - v.eye.z) / d.z;
    const float t = larger((towards_axis(v, d) - root) / a, cap_in);
    const float t_out = smaller((towards_axis(v, d) + root) / a, cap_out);
    const int face = t == cap_in ? 1 : 0;
    return {t, (square >= 0.0f) & (t > 0.0f) & (t <= t_out) ? face : -1};
  }
  DODGESIM_INLINE static FacePoint point(const SolidView& v, int face, const Vec3& d) {
    const float cap = sign_of(v.eye.z);
    const bool side = face == 0;
    const float t_side = side_t(v, d, v.size.x), t_cap = (cap * v.size.z - v.eye.z) / d.z;
    const float t = side ? t_side : t_cap;
    const Vec3 p = v.eye + t * d;
    const Vec3 n = normalized({p.x, p.y, 0.0f});
    // A ray along the plane of the cap meets it nowhere.
    const float x = within(p.x, v.size.x), y = within(p.y, v.size.x);
    return face_point({side ? p.x : x, side ? p.y : y, within(p.z, v.size.z)},
                      {side ? n.x : 0.0f, side ? n.y : 0.0f, side ? 0.0f : cap});
  }
};

struct Capsule {
  static constexpr int kFaces = 1;

  // The margin of a larger solid is in its radius alone.
  DODGESIM_INLINE static Roots roots(const SolidView& v, float radius, const Vec3& d) {
    const float side_square = reach(v, d, radius), t_side = side_t(v, d, radius);
    const float z = v.eye.z + t_side * d.z;
    const Vec3 e = {v.eye.x, v.eye.y, v.eye.z - sign_of(z) * v.size.z};
    const Vec3 moment = cross(e, d);
    const float a = dot(d, d), square = radius * radius * a - dot(moment, moment);
    const float t_end = (-dot(e, d) - root_of(square)) / a;
    const bool at_end = magnitude(z) > v.size.z;
    return {at_end ? square : side_square, at_end ? t_end : t_side};
  }
  DODGESIM_INLINE static Entry entry(const SolidView& v, const Vec3& size, const Vec3& d) {
    const Roots r = roots(v, size.x, d);
    return {r.t, (r.square >= 0.0f) & (r.t > 0.0f) ? 0 : -1};
  }
  DODGESIM_INLINE static FacePoint point(const SolidView& v, int, const Vec3& d) {
    const Roots r = roots(v, v.size.x, d);
    const Vec3 p = v.eye + r.t * d;
    return face_point(p, normalized({p.x, p.y, p.z - within(p.z, v.size.z)}));
  }
};

// The outline of an ellipsoid, and that of an endless cylinder, is a conic: the zero set of a
// quadratic form in pixel coordinates.
struct OutlineDistance {
  float s;         // along the gradient, exact for the form; positive inside [px]
  float n_x, n_y;  // unit gradient
};
// The form, and its gradient.
struct OutlineForm {
  float g, g_x, g_y;
};
DODGESIM_INLINE OutlineForm outline_form(const SolidView& v, float x, float y) {
  const float* c = v.conic;
  const float q_x = c[0] * x + c[1] * y + c[2];
  const float q_y = c[3] * x + c[4] * y + c[5];
  return {q_x * x + q_y * y + (c[6] * x + c[7] * y + c[8]), 2.0f * q_x, 2.0f * q_y};
}
// Whether the outline may be nearer than `far`: over that way the form changes by no more than far
// |gradient| + far^2 |its second-order part|, whose norms sums of absolute values bound.
DODGESIM_INLINE bool outline_is_near(const SolidView& v, const OutlineForm& form, float far) {
  const float* c = v.conic;
  const float bend = magnitude(c[0]) + magnitude(c[1]) + magnitude(c[3]) + magnitude(c[4]);
  const float slope = magnitude(form.g_x) + magnitude(form.g_y);
  return !(magnitude(form.g) > far * (slope + far * bend));
}
DODGESIM_INLINE OutlineDistance outline_distance(const SolidView& v, float x, float y) {
  const float* c = v.conic;
  const auto [g, g_x, g_y] = outline_form(v, x, y);
  const float steepness = std::sqrt(g_x * g_x + g_y * g_y);
  const bool steep = steepness > 0.0f;
  const float n_x = steep ? g_x / steepness : 1.0f, n_y = steep ? g_y / steepness : 0.0f;
  const float curvature =
      2.0f * (n_x * (c[0] * n_x + c[1] * n_y) + n_y * (c[3] * n_x + c[4] * n_y));
  const float root = root_of(steepness * steepness - 2.0f * curvature * g);
  return {2.0f * g / larger(steepness + root, 1e-30f), n_x, n_y};
}

// Part of a square of the given width that lies on the inner side of a line at the distance s from
// its centre (positive: centre inside).
DODGESIM_INLINE float half_plane_coverage(const OutlineDistance& line, float width) {
  const float n_x = magnitude(line.n_x), n_y = magnitude(line.n_y);
  const float a = larger(n_x, n_y), b = smaller(n_x, n_y);
  const float d = magnitude(line.s) / width, h = 0.5f * (a + b), beyond = larger(h - d, 0.0f);
  // Beyond the line, away from the centre: a trapezium, or a triangle.
  const float outside =
      d <= 0.5f * (a - b) ? 0.5f - d / a : beyond * beyond / larger(2.0f * a * b, 1e-30f);
  return line.s >= 0.0f ? 1.0f - outside : outside;
}

}  // namespace solid

}  // namespace dodgesim
