#include "sim/render/solid_kernels.h"

#include <array>
#include <bit>
#include <limits>
#include <type_traits>

namespace dodgesim {

namespace {

template <class Solid>
DODGESIM_INLINE void put_points(const SolidView& view, int face, float column, float row, int size,
                                float* __restrict x, float* __restrict y, float* __restrict z,
                                float* __restrict n_x, float* __restrict n_y,
                                float* __restrict n_z) {
  const SolidView v = view;
  for (int i = 0; i < size; ++i) {
    const Vec3 d = solid::ray(v, column + static_cast<float>(i), row);
    const solid::FacePoint at = Solid::point(v, face, d);
    x[i] = at.x;
    y[i] = at.y;
    z[i] = at.z;
    n_x[i] = at.n_x;
    n_y[i] = at.n_y;
    n_z[i] = at.n_z;
  }
}

// The vectoriser believes parameters that they do not overlap.
template <class Solid>
DODGESIM_INLINE void points_row(const SolidView& view, int face, float column, float row, int size,
                                const PointRow& points) {
  put_points<Solid>(view, face, column, row, size, points.x, points.y, points.z, points.n_x,
                    points.n_y, points.n_z);
}

template <class Solid>
DODGESIM_INLINE void entries_row(const SolidView& view, float larger_by, float column, float row,
                                 int size, const EntryRow& entries) {
  const SolidView v = view;
  const Vec3 solid_size = {v.size.x + larger_by, v.size.y + larger_by, v.size.z + larger_by};
  float* const __restrict t = entries.t;
  int* const __restrict face = entries.face;
  for (int i = 0; i < size; ++i) {
    const Vec3 d = solid::ray(v, column + static_cast<float>(i), row);
    const solid::Entry at = Solid::entry(v, solid_size, d);
    t[i] = at.t;
    face[i] = at.face;
  }
}

DODGESIM_INLINE void side_entries_row(const SolidView& view, float column, float row, int size,
                                      const EntryRow& entries) {
  const SolidView v = view;
  float* const __restrict t = entries.t;
  int* const __restrict face = entries.face;
  for (int i = 0; i < size; ++i) {
    const solid::Entry at =
        solid::side_entry(v, solid::ray(v, column + static_cast<float>(i), row));
    t[i] = at.t;
    face[i] = at.face;
  }
}

// For the time being, of pixels that the outline may cut.
constexpr float kCut = 0.5f;

// Replaces kCut in `size` pixels. In each of pieces x pieces parts of a pixel the outline is taken
// as straight.
DODGESIM_INLINE void cover_cut_pixels(const SolidView& v, float column, float y, int size,
                                      float* __restrict coverage) {
  int cut = 0;
  for (int i = 0; i < size; ++i) cut |= coverage[i] == kCut ? 1 : 0;
  if (cut == 0) return;
  float sum[kRowLanes] = {};
  const float width = 1.0f / static_cast<float>(v.pieces), first = 0.5f * width - 0.5f;
  for (int part = 0; part < v.pieces * v.pieces; ++part) {
    const int part_column = part % v.pieces, part_row = part / v.pieces;
    const float right = first + width * static_cast<float>(part_column);
    const float down = y + first + width * static_cast<float>(part_row);
    for (int i = 0; i < size; ++i) {
      const float x = (column + static_cast<float>(i)) - v.conic_x;
      const auto line = solid::outline_distance(v, x + right, down);
      sum[i] += solid::half_plane_coverage(line, width);
    }
  }
  for (int i = 0; i < size; ++i) {
    coverage[i] = coverage[i] == kCut ? sum[i] * (width * width) : coverage[i];
  }
}

DODGESIM_INLINE void outline_coverage_row(const SolidView& view, float column, float row, int size,
                                          float* __restrict coverage) {
  constexpr float kFar = 0.75f;  // [px], more than half a pixel's diagonal
  const SolidView v = view;
  const float y = row - v.conic_y;
  for (int i = 0; i < size; ++i) {
    const float x = (column + static_cast<float>(i)) - v.conic_x;
    const solid::OutlineForm form = solid::outline_form(v, x, y);
    const float all_or_none = form.g > 0.0f ? 1.0f : 0.0f;
    coverage[i] = solid::outline_is_near(v, form, kFar) ? kCut : all_or_none;
  }
  for (int begin = 0; begin < size; begin += kRowLanes) {
    const float first = column + static_cast<float>(begin);
    if (begin + kRowLanes <= size) {
      cover_cut_pixels(v, first, y, kRowLanes, coverage + begin);
    } else {
      cover_cut_pixels(v, first, y, size - begin, coverage + begin);
    }
  }
}

// Offsets of the rays of a pixel from its centre [px]: ray i lies in column i and in the row whose
// number has the bits of i the other way round.
struct RayPattern {
  std::array<float, kRaysPerPixel> x{}, y{};
};

constexpr RayPattern make_ray_pattern() {
  RayPattern pattern;
  for (unsigned i = 0; i < kRaysPerPixel; ++i) {
    unsigned row = 0;
    for (unsigned bit = 0; bit < 6; ++bit) row |= ((i >> bit) & 1u) << (5 - bit);
    pattern.x[i] = (static_cast<float>(i) + 0.5f) / kRaysPerPixel - 0.5f;
    pattern.y[i] = (static_cast<float>(row) + 0.5f) / kRaysPerPixel - 0.5f;
  }
  return pattern;
}

constexpr RayPattern kRays = make_ray_pattern();

template <class Solid>
DODGESIM_INLINE float rays_of_pixel(const SolidView& view, float column, float row,
                                    int (&counts)[kMostFaces]) {
  const SolidView v = view;
  // Positive floats are ordered like their bits.
  constexpr int kNone = std::bit_cast<int>(std::numeric_limits<float>::max());
  int face[kRaysPerPixel], depth[kRaysPerPixel];
  for (std::size_t i = 0; i < kRaysPerPixel; ++i) {
    const Vec3 d = solid::ray(v, column + kRays.x[i], row + kRays.y[i]);
    const solid::Entry at = Solid::entry(v, v.size, d);
    face[i] = at.face;
    depth[i] = at.face >= 0 ? std::bit_cast<int>(at.t) : kNone;
  }
  for (int k = 0; k < static_cast<int>(kMostFaces); ++k) {
    int count = 0;
    for (const int met : face) count += met == k ? 1 : 0;
    counts[k] = count;
  }
  int nearest = kNone;
  for (const int ray_depth : depth) nearest = smaller(nearest, ray_depth);
  return nearest == kNone ? 0.0f : std::bit_cast<float>(nearest);
}

template <class Solid>
constexpr SolidKernels kernels_of(int level, decltype(SolidKernels::side_entries) side_entries) {
  return {Solid::kFaces,
          std::is_same_v<Solid, solid::Ellipsoid>,
          compiled_for<points_row<Solid>>(level),
          compiled_for<entries_row<Solid>>(level),
          side_entries,
          compiled_for<outline_coverage_row>(level),
          compiled_for<rays_of_pixel<Solid>>(level)};
}

constexpr std::array<SolidKernels, kSolidTypes> kernels(int level) {
  const auto side = compiled_for<side_entries_row>(level);
  return {kernels_of<solid::Ellipsoid>(level, nullptr), kernels_of<solid::Capsule>(level, side),
          kernels_of<solid::Cylinder>(level, side), kernels_of<solid::Box>(level, nullptr)};
}

constexpr std::array<std::array<SolidKernels, kSolidTypes>, kVectorLevels> kKernels = {
    kernels(kPortable), kernels(kAvx2), kernels(kAvx512)};

}  // namespace

const SolidKernels& solid_kernels(SolidType type, int level) {
  return kKernels[static_cast<std::size_t>(level)][static_cast<std::size_t>(type)];
}

}  // namespace dodgesim
