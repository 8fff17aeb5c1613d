// Loops over pixels that light, texture and blend what solid_kernels.h finds, compiled for each
// width of vectors (see sim/base/vector_level.h). All give the same bytes.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/vector_level.h"
#include "sim/render/solid_kernels.h"

namespace dodgesim {

// Lights of a scene in the frame G of a geom.
struct LightsInG {
  struct Directional {
    Vec3 beam;
    float ambient, diffuse;
  };
  struct Lamp {
    Vec3 position, beam;
    float cos_cutoff, exponent;
    Vec3 attenuation;  // 1, d, d^2
    float ambient, diffuse;
  };
  float ambient;
  std::vector<Directional> directional;
  std::vector<Lamp> lamps;
};

// How a texture lies on a solid: texture_pyramid.h and the mapping of Surface.
struct TextureOnSolid {
  const std::uint32_t* pairs;
  float unit;
  const int* first;   // of each level
  int width, height;  // of the first level; each is half as large as the one before, but not 0
  int last_level;
  Vec3 scale, offset;
  float sharpness;  // 2^bias: of a bias that is added to the level
};

enum class TextureRead { k2dNearestLevel, k2dTwoLevels, kCubeNearestLevel, kCubeTwoLevels };
inline constexpr int kTextureReads = 4;

struct SurfaceKernels {
  // luminance[i] = albedo * light + emission. Lambertian; `points` are read only.
  void (*light)(const LightsInG& lights, float albedo, float emission, const PointRow& points,
                int size, float* luminance);
  // Multiplies luminance[i] by the texel at points[i]. The next point, points[size] too, and the
  // one below tell how large a pixel is there.
  void (*texture[kTextureReads])(const TextureOnSolid& texture, const PointRow& points,
                                 const PointRow& below, int size, float* luminance);
  // sum[i] += share[i] * value[i] where the share is not 0.
  void (*accumulate)(const float* value, const float* share, int size, float* sum);
  // luminance[i] goes towards sum[i] / coverage[i] by coverage[i], where t[i] is positive.
  void (*blend)(const float* sum, const float* coverage, const float* t, int size,
                float* luminance);
};

const SurfaceKernels& surface_kernels(int level = vector_level());

}  // namespace dodgesim
