#include "sim/render/solid_coverage.h"

#include <algorithm>
#include <utility>

namespace dodgesim {

void SolidCoverage::start(const SolidKernels& kernels, const SolidView& view, int width,
                          bool depths) {
  kernels_ = &kernels;
  view_ = view;
  have_below_ = false;
  depths_ = depths || !kernels.conic_is_outline;
  const auto size = static_cast<std::size_t>(whole_vectors(width + 1));  // corners are one more
  if (whole_.size() < size) {
    for (auto* row :
         {&shares_[0], &shares_[1], &shares_[2], &whole_, &depth_, &depth_at_center_, &outline_}) {
      row->resize(size);
    }
    for (auto* entries :
         {&center_, &close_, &side_, &above_.all, &above_.side, &below_.all, &below_.side}) {
      entries->resize(size);
    }
  }
  if (!depths_) std::fill(depth_.begin(), depth_.end(), 1.0f);
}

void SolidCoverage::cast_centers(int column, int row, int size) {
  kernels_->entries(view_, 0.0f, static_cast<float>(column), static_cast<float>(row),
                    whole_vectors(size), center_.row());
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
    depth_[i] = center_.t[i];
    depth_at_center_[i] = center_.face[i] >= 0 ? center_.t[i] : 0.0f;
  }
}

void SolidCoverage::compute(int column, int row, int size) {
  if (depths_) cast_centers(column, row, size);
  if (kernels_->conic_is_outline) {
    kernels_->outline_coverage(view_, static_cast<float>(column), static_cast<float>(row),
                               whole_vectors(size), shares_[0].data());
    std::copy_n(shares_[0].begin(), size, whole_.begin());
    any_[0] = true;
    return;
  }
  count_faces(column, row, size);
}

void SolidCoverage::count_faces(int column, int row, int size) {
  const float x = static_cast<float>(column), y = static_cast<float>(row);
  const int lanes = whole_vectors(size);
  kernels_->entries(view_, view_.margin, x, y, lanes, close_.row());
  if (kernels_->side_entries) {
    kernels_->side_entries(view_, x, y, lanes, side_.row());
    kernels_->outline_coverage(view_, x, y, lanes, outline_.data());
  }
  std::swap(above_, below_);
  if (!have_below_) cast_corners(column, row, size, above_);
  cast_corners(column, row + 1, size, below_);
  have_below_ = true;

  any_.fill(false);
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) cover(column, row, i);
}

// The corners above a row of pixels.
void SolidCoverage::cast_corners(int column, int row, int size, Corners& corners) {
  const float x = static_cast<float>(column) - 0.5f, y = static_cast<float>(row) - 0.5f;
  const int lanes = whole_vectors(size + 1);
  kernels_->entries(view_, 0.0f, x, y, lanes, corners.all.row());
  if (kernels_->side_entries) kernels_->side_entries(view_, x, y, lanes, corners.side.row());
}

// All of the pixel if its centre and corners meet one face, none if its centre is not close to the
// solid, analytic where it sees only the round side, else counted with rays. A camera that is close
// itself is within the larger solid, which no ray enters.
void SolidCoverage::cover(int column, int row, std::size_t i) {
  const auto all = [i](const Corners& a, const Corners& b, auto part, int face) {
    const auto &p = (a.*part).face, &q = (b.*part).face;
    return p[i] == face && p[i + 1] == face && q[i] == face && q[i + 1] == face;
  };
  for (auto& share : shares_) share[i] = 0;
  whole_[i] = 0;
  const int face = center_.face[i];
  if (face >= 0 && all(above_, below_, &Corners::all, face)) {
    shares_[static_cast<std::size_t>(face)][i] = whole_[i] = 1;
    any_[static_cast<std::size_t>(face)] = true;
    return;
  }
  if (face < 0 && close_.face[i] < 0) return;
  const bool round = kernels_->side_entries != nullptr;
  if (round && all(above_, below_, &Corners::side, 0)) {
    if (face < 0) depth_[i] = side_.t[i];
    shares_[0][i] = whole_[i] = outline_[i];
    any_[0] = true;
    return;
  }
  int counts[kMostFaces];
  const float nearest = kernels_->count_rays(
      view_, static_cast<float>(column) + static_cast<float>(i), static_cast<float>(row), counts);
  if (face < 0) depth_[i] = nearest;
  for (std::size_t k = 0; k < kMostFaces; ++k) {
    shares_[k][i] = static_cast<float>(counts[k]) / kRaysPerPixel;
    whole_[i] += shares_[k][i];
    any_[k] = any_[k] || counts[k] > 0;
  }
}

}  // namespace dodgesim
