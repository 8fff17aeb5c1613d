#include "sim/render/surface_kernels.h"

#include <array>
#include <bit>
#include <cmath>

namespace dodgesim {

namespace {

using solid::dot;
using solid::magnitude;

DODGESIM_INLINE Vec3 normal_of(const PointRow& points, int i) {
  return {points.n_x[i], points.n_y[i], points.n_z[i]};
}

DODGESIM_INLINE Vec3 point_of(const PointRow& points, int i) {
  return {points.x[i], points.y[i], points.z[i]};
}

// A spot's exponent is left to the C library, which may round otherwise on another processor.
template <bool kSpot>
DODGESIM_INLINE void add_lamp(const LightsInG::Lamp& lamp, const PointRow& row, int size,
                              float* __restrict light) {
  using namespace solid;
  const LightsInG::Lamp l = lamp;
  const PointRow points = row;
  for (int i = 0; i < size; ++i) {
    const Vec3 way = point_of(points, i) - l.position;
    const float d = std::sqrt(dot(way, way));
    const Vec3 ray = (1.0f / d) * way;
    float strength = 1.0f / (l.attenuation.x + d * (l.attenuation.y + d * l.attenuation.z));
    const float c = dot(ray, l.beam);
    if constexpr (kSpot) strength *= std::pow(larger(c, 0.0f), l.exponent);
    strength = c < l.cos_cutoff ? 0.0f : strength;
    light[i] += strength * (l.ambient + l.diffuse * larger(-dot(normal_of(points, i), ray), 0.0f));
  }
}

DODGESIM_INLINE void light_row(const LightsInG& lights, float albedo, float emission,
                               const PointRow& row, int size, float* __restrict light) {
  const PointRow points = row;
  const float ambient = lights.ambient;
  for (int i = 0; i < size; ++i) light[i] = ambient;
  for (const LightsInG::Directional& directional : lights.directional) {
    const LightsInG::Directional l = directional;
    for (int i = 0; i < size; ++i) {
      light[i] += l.ambient + l.diffuse * larger(-dot(normal_of(points, i), l.beam), 0.0f);
    }
  }
  for (const LightsInG::Lamp& lamp : lights.lamps) {
    if (lamp.exponent != 0.0f) {
      add_lamp<true>(lamp, points, size, light);
    } else {
      add_lamp<false>(lamp, points, size, light);
    }
  }
  for (int i = 0; i < size; ++i) light[i] = albedo * light[i] + emission;
}

// A place on a face of a texture: from 0 to 1 along its width and height, and the steps from there
// to the next pixels, in the same units.
struct TexturePlace {
  int face;
  float u, v;
  float u_right, v_right, u_down, v_down;
};

DODGESIM_INLINE float fraction_of(float coordinate) {
  const float x = solid::within(coordinate, 0x1p24f);  // beyond that there are no fractions
  const float whole = static_cast<float>(static_cast<int>(x));
  return x - (whole > x ? whole - 1.0f : whole);
}

DODGESIM_INLINE TexturePlace place_2d(const Vec3& at, const Vec3& right, const Vec3& down) {
  return {0, fraction_of(at.x), fraction_of(at.y), right.x, right.y, down.x, down.y};
}

// OpenGL 3.3, table 3.19: a face by the largest component m of a direction; s and t are the others
// over it, but for signs.
DODGESIM_INLINE TexturePlace place_cube(const Vec3& at, const Vec3& right, const Vec3& down) {
  const float x = magnitude(at.x), y = magnitude(at.y), z = magnitude(at.z);
  const int on_x = -static_cast<int>((x >= y) & (x >= z));
  const int on_y = -static_cast<int>(y >= z) & ~on_x;
  const auto main_of = [&](const Vec3& d) { return chosen(on_x, d.x, chosen(on_y, d.y, d.z)); };
  const float main = main_of(at), side = solid::sign_of(main);
  const int face = (4 & ~(on_x | on_y)) + (2 & on_y) + (1 & (std::bit_cast<int>(side) >> 31));
  const float s_sign = chosen(on_x, -side, chosen(on_y, 1.0f, side));
  const float t_sign = chosen(on_y, side, -1.0f);
  const auto s_of = [&](const Vec3& d) { return s_sign * chosen(on_x, d.z, d.x); };
  const auto t_of = [&](const Vec3& d) { return t_sign * chosen(on_y, d.z, d.y); };
  const auto m_of = [&](const Vec3& d) { return side * main_of(d); };
  const float half = 0.5f / magnitude(main), s = 2.0f * half * s_of(at), t = 2.0f * half * t_of(at);
  const auto bounded = [](float c) { return smaller(larger(0.5f * c + 0.5f, 0.0f), 1.0f); };
  return {face,
          bounded(s),
          bounded(t),
          half * (s_of(right) - s * m_of(right)),
          half * (t_of(right) - t * m_of(right)),
          half * (s_of(down) - s * m_of(down)),
          half * (t_of(down) - t * m_of(down))};
}

DODGESIM_INLINE float code(std::uint32_t bits) {
  return static_cast<float>(static_cast<std::int32_t>(bits));
}

// Straight between four texels.
DODGESIM_INLINE float texel(const TextureOnSolid& x, const TexturePlace& at, int level) {
  const int width = larger(x.width >> level, 1), height = larger(x.height >> level, 1);
  const int stride = width + 2;
  const float u = at.u * static_cast<float>(width) + 0.5f;
  const float v = at.v * static_cast<float>(height) + 0.5f;
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const float fu = u - static_cast<float>(column), fv = v - static_cast<float>(row);
  const int top = x.first[level] + (at.face * (height + 2) + row) * stride + column;
  const std::uint32_t above = x.pairs[top], beneath = x.pairs[top + stride];
  const float a = code(above & 0xffff), b = code(above >> 16);
  const float c = code(beneath & 0xffff), d = code(beneath >> 16);
  const float upper = a + fu * (b - a), lower = c + fu * (d - c);
  return x.unit * (upper + fv * (lower - upper));
}

constexpr int kMantissaBits = 23, kExponentBias = 127;

DODGESIM_INLINE int exponent_of(float x) {
  return (std::bit_cast<int>(x) >> kMantissaBits) - kExponentBias;
}

// Of positive numbers, to 2e-6.
DODGESIM_INLINE float log2_of(float x) {
  const int exponent = exponent_of(x);
  const float m = std::bit_cast<float>(std::bit_cast<int>(x) - (exponent << kMantissaBits));
  constexpr float kRoot = 1.41421356f, kFactor = 2.88539008f;  // 2 / ln 2
  const float r = (m - kRoot) / (m + kRoot), r2 = r * r;
  const float series = r * (1.0f + r2 * (1.0f / 3 + r2 * (1.0f / 5)));
  return static_cast<float>(exponent) + (0.5f + kFactor * series);
}

// The squared size of a pixel in texels of the first level, the longer side counting.
DODGESIM_INLINE float squared_step(const TextureOnSolid& x, const TexturePlace& at) {
  const float w = static_cast<float>(x.width), h = static_cast<float>(x.height);
  const float u_right = w * at.u_right, v_right = h * at.v_right;
  const float u_down = w * at.u_down, v_down = h * at.v_down;
  const float square =
      larger(u_right * u_right + v_right * v_right, u_down * u_down + v_down * v_down);
  // Enough for the levels of any texture, and never infinite or not a number.
  return smaller(larger(x.sharpness * x.sharpness * square, 1e-18f), 1e18f);
}

template <bool kCube, bool kTwoLevels>
DODGESIM_INLINE void texture_row(const TextureOnSolid& texture, const PointRow& points,
                                 const PointRow& below, int size, float* __restrict luminance) {
  using namespace solid;
  const TextureOnSolid x = texture;
  const PointRow here = points, next = below;
  for (int i = 0; i < size; ++i) {
    const Vec3 p = point_of(here, i);
    const Vec3 at = times(p, x.scale) + x.offset;
    const Vec3 right = times(point_of(here, i + 1) - p, x.scale);
    const Vec3 down = times(point_of(next, i) - p, x.scale);
    const TexturePlace place = kCube ? place_cube(at, right, down) : place_2d(at, right, down);
    const float square = squared_step(x, place);
    if constexpr (kTwoLevels) {
      const float last = static_cast<float>(x.last_level);
      const float level = smaller(larger(0.5f * log2_of(square), 0.0f), last);
      const int sharp = static_cast<int>(level);
      const int blurred = smaller(sharp + 1, x.last_level);
      const float near = texel(x, place, sharp), far = texel(x, place, blurred);
      luminance[i] *= near + (level - static_cast<float>(sharp)) * (far - near);
    } else {
      // floor(log2(step) + 1/2)
      const int nearest = exponent_of(2.0f * square) >> 1;
      luminance[i] *= texel(x, place, smaller(larger(nearest, 0), x.last_level));
    }
  }
}

DODGESIM_INLINE void accumulate_row(const float* __restrict value, const float* __restrict share,
                                    int size, float* __restrict sum) {
  for (int i = 0; i < size; ++i) sum[i] = share[i] > 0.0f ? sum[i] + share[i] * value[i] : sum[i];
}

DODGESIM_INLINE void blend_row(const float* __restrict sum, const float* __restrict coverage,
                               const float* __restrict t, int size, float* __restrict luminance) {
  for (int i = 0; i < size; ++i) {
    const bool shown = (coverage[i] > 0.0f) & (t[i] > 0.0f);
    // A coverage that is summed up may be rounded to more than 1.
    const float blended = larger(sum[i] + (1.0f - coverage[i]) * luminance[i], 0.0f);
    luminance[i] = shown ? blended : luminance[i];
  }
}

constexpr SurfaceKernels kernels(int level) {
  return {
      compiled_for<light_row>(level),
      {compiled_for<texture_row<false, false>>(level),
       compiled_for<texture_row<false, true>>(level), compiled_for<texture_row<true, false>>(level),
       compiled_for<texture_row<true, true>>(level)},
      compiled_for<accumulate_row>(level),
      compiled_for<blend_row>(level)};
}

constexpr std::array<SurfaceKernels, kVectorLevels> kKernels = {kernels(kPortable), kernels(kAvx2),
                                                                kernels(kAvx512)};

}  // namespace

const SurfaceKernels& surface_kernels(int level) {
  return kKernels[static_cast<std::size_t>(level)];
}

}  // namespace dodgesim
