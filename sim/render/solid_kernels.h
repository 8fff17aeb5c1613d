// Loops over pixels that ray-cast solids (solids.h), compiled for each width of vectors (see
// sim/base/vector_level.h). All give the same bytes.
#pragma once

#include <cstddef>

#include "sim/base/vector_level.h"
#include "sim/render/solids.h"

namespace dodgesim {

// Rows of whole vectors of this many pixels are the fastest.
inline constexpr int kRowLanes = 16;
inline constexpr int whole_vectors(int size) {
  return (size + kRowLanes - 1) / kRowLanes * kRowLanes;
}

// Points of a face that the rays of pixels side by side meet, in the geom's frame G.
struct PointRow {
  float *x, *y, *z;        // [m]
  float *n_x, *n_y, *n_z;  // outer normal
};

// What some rays meet: t and face as of solid::Entry.
struct EntryRow {
  float* t;
  int* face;
};

inline constexpr std::size_t kMostFaces = 3;
inline constexpr int kRaysPerPixel = 64;

// Of one type of solid. Pixels are (column, row), (column + 1, row), ...
struct SolidKernels {
  int faces;
  bool conic_is_outline;  // the whole of it, and there is one face
  void (*points)(const SolidView& view, int face, float column, float row, int size,
                 const PointRow& points);
  // `larger_by` makes the solid larger [m].
  void (*entries)(const SolidView& view, float larger_by, float column, float row, int size,
                  const EntryRow& entries);
  // Where rays meet the round side between two ends; null if there is none.
  void (*side_entries)(const SolidView& view, float column, float row, int size,
                       const EntryRow& entries);
  // Part of each pixel within the conic.
  void (*outline_coverage)(const SolidView& view, float column, float row, int size,
                           float* coverage);
  // One pixel with kRaysPerPixel rays, no two of which share a column or a row: how many meet each
  // face. Returns the least depth of those that meet one, 0 if none does.
  float (*count_rays)(const SolidView& view, float column, float row, int (&counts)[kMostFaces]);
};

enum class SolidType { kEllipsoid, kCapsule, kCylinder, kBox };
inline constexpr int kSolidTypes = 4;

const SolidKernels& solid_kernels(SolidType type, int level = vector_level());

}  // namespace dodgesim
