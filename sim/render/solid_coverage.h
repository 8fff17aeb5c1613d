// How much of each pixel of a row a ray-cast solid covers, face by face, and how far it is there.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/render/solid_kernels.h"

namespace dodgesim {

class SolidCoverage {
 public:
  // Takes a solid, in images of at most `width` pixels. Without depths, compute() may leave out how
  // far it is: all of it must be in front of the camera.
  void start(const SolidKernels& kernels, const SolidView& view, int width, bool depths = true);

  // Of the pixels (column, row) to (column + size - 1, row): what their centres meet; or all. Rows
  // of a solid have the same columns and follow one another from the top down: two of them share
  // the corners of their pixels. What lies beyond them in the last vector means nothing.
  void cast_centers(int column, int row, int size);
  void compute(int column, int row, int size);

  // Of the last compute(). The part of each pixel that a face covers, and whether it covers any of
  // the row; the sum over all faces.
  const float* share(int face) const { return shares_[static_cast<std::size_t>(face)].data(); }
  bool any(int face) const { return any_[static_cast<std::size_t>(face)]; }
  const float* whole() const { return whole_.data(); }
  // Depth z_C of what is seen of the solid [m] where whole() is more than 0: where the pixel's
  // centre meets it, else where that passes closest to a round side, else of the nearest point.
  // Without depths only its sign means something.
  const float* depth() const { return depth_.data(); }

  // Of the last call of either: the depth [m] where the pixel's centre meets the solid, else 0.
  const float* depth_at_center() const { return depth_at_center_.data(); }

 private:
  struct Entries {
    std::vector<float> t;
    std::vector<int> face;
    void resize(std::size_t size) { t.resize(size), face.resize(size); }
    EntryRow row() { return {t.data(), face.data()}; }
  };
  // What the rays through the corners above or below a row of pixels meet.
  struct Corners {
    Entries all, side;
  };

  void count_faces(int column, int row, int size);
  void cover(int column, int row, std::size_t pixel);
  void cast_corners(int column, int row, int size, Corners& corners);

  const SolidKernels* kernels_ = nullptr;
  SolidView view_{};
  std::array<std::vector<float>, kMostFaces> shares_;
  std::array<bool, kMostFaces> any_{};
  std::vector<float> whole_, depth_, depth_at_center_, outline_;
  Entries center_, close_, side_;
  Corners above_, below_;
  bool depths_ = true;
  bool have_below_ = false;
};

}  // namespace dodgesim
