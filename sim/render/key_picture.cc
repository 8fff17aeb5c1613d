#include "sim/render/key_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/branchless.h"
#include "sim/render/key_kernels.h"

namespace dodgesim {

namespace {

// Bounds in single precision are made so much larger.
constexpr float kRoundedUp = 1 + 0x1p-20f;

// Rounding of poses.
constexpr double kSamePose = 1e-9;

// Where the view's pixels fall between means decides how sharp they are. With this share of the
// view's focal length they fall everywhere, at every pose: no view is sharper than the others.
constexpr double kFocalShare = 0.99;

// Nodes this near the border of the key count as outside [px].
constexpr float kBorderPx = 0.01f;

// How far the straight lines between nodes may be from the picture of a turned camera, which bends
// them [px of the view].
constexpr double kMaxBendPx = 0.1;

int cells_of(int pixels) { return (pixels + kKeyCellPx - 1) / kKeyCellPx; }

// The cells that hold a region's pixels.
Rect cells_about(const Rect& region) {
  return {region.x0 / kKeyCellPx, region.y0 / kKeyCellPx, cells_of(region.x1), cells_of(region.y1)};
}

std::size_t area(const Intrinsics& picture) {
  return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
}

// Rays of the view's pixels in the key's frame.
Eigen::Matrix3d directions(const Intrinsics& view, const Eigen::Matrix3d& R_KC) {
  Eigen::Matrix3d ray;
  ray << 1 / view.f, 0, -view.cx() / view.f, 0, 1 / view.f, -view.cy() / view.f, 0, 0, 1;
  return R_KC * ray;
}

}  // namespace

KeyPicture::KeyPicture(const Intrinsics& view, const KeySpec& spec)
    : view_(view),
      supersampling_(static_cast<int>(spec.supersampling)),
      columns_(cells_of(view.width) + 1),
      every_picture_(spec.max_misplacement_px <= 0),
      max_misplacement_px_(spec.max_misplacement_px),
      max_zoom_(spec.max_zoom) {
  const int margin = static_cast<int>(spec.margin_px);
  const double f = every_picture_ ? view.f : kFocalShare * view.f;
  wide_ = {view.width + 2 * margin, view.height + 2 * margin, f};
  fine_ = {supersampling_ * wide_.width, supersampling_ * wide_.height, supersampling_ * f};
  means_.resize(area(fine_) +
                static_cast<std::size_t>(std::max(kKeySpareRows * fine_.width, kKeySpareMeans)));
  scratch_row_.resize(static_cast<std::size_t>(fine_.width));
  sharp_row_.resize(scratch_row_.size());
  for (auto& row : mean_rows_) row.resize(scratch_row_.size());
  inverse_depth_.resize(area(wide_));
  tile_columns_ = cells_of(wide_.width);
  tile_nearest_.resize(tile(0, cells_of(wide_.height)));
  const auto nodes =
      static_cast<std::size_t>(columns_) * static_cast<std::size_t>(cells_of(view.height) + 1);
  node_u_.resize(nodes);
  node_v_.resize(nodes);
  for (auto* const row : {&cell_u_, &cell_v_, &step_u_, &step_v_}) {
    row->resize(static_cast<std::size_t>(columns_));
  }
  row_.resize(static_cast<std::size_t>(columns_) * kKeyCellPx);
}

void KeyPicture::set(const Eigen::Isometry3d& X_WC, const std::vector<float>& luminance,
                     const std::vector<float>& inverse_depth) {
  X_KW_ = X_WC.inverse();
  set_aperture_means(luminance);
  set_depth(inverse_depth);
  is_set_ = true;
}

// Means over n x n pixels for supersampling n, n - 1 fewer across and down. The mean that begins at
// pixel (i, j) is number (i, j).
void KeyPicture::set_aperture_means(const std::vector<float>& luminance) {
  const int rows = fine_.height - supersampling_ + 1;
  // Sharpening looks at the rows above and below.
  for (int j = 0; j < rows; ++j) {
    take_means(luminance, j, mean_rows_[static_cast<std::size_t>(j % kMeanRows)]);
    if (j == 1) put_means(0, 0, 0, 1);
    if (j > 1) put_means(j - 1, j - 2, j - 1, j);
  }
  put_means(rows - 1, std::max(rows - 2, 0), rows - 1, rows - 1);
}

void KeyPicture::take_means(const std::vector<float>& luminance, int j, std::vector<float>& means) {
  key_kernels().means(luminance.data() + std::ptrdiff_t{j} * fine_.width, fine_.width,
                      supersampling_, fine_.width, scratch_row_.data(), means.data());
}

// Row j of means_, from the rows above it, of it and below it.
void KeyPicture::put_means(int j, int above, int at, int below) {
  const auto row = [this](int k) {
    return mean_rows_[static_cast<std::size_t>(k % kMeanRows)].data();
  };
  const int size = fine_.width - supersampling_ + 1;
  const float* means = row(at);
  if (!every_picture_) {  // else they are read at the means themselves
    key_kernels().sharpen(row(above), means, row(below), size, scratch_row_.data(),
                          sharp_row_.data());
    means = sharp_row_.data();
  }
  key_kernels().halve(means, size, means_.data() + std::ptrdiff_t{j} * fine_.width);
}

// Of the pixels of a fine block the nearest counts, so that nothing thin is lost.
void KeyPicture::set_depth(const std::vector<float>& inverse_depth) {
  const int n = supersampling_;
  for (int j = 0; j < wide_.height; ++j) {
    key_kernels().largest(inverse_depth.data() + std::ptrdiff_t{j * n} * fine_.width, fine_.width,
                          n, wide_.width, inverse_depth_.data() + std::ptrdiff_t{j} * wide_.width);
  }
  nearest_inverse_m_ = 0;
  misplacement_px_per_m_ = 0;
  for (int y = 0; y < wide_.height; y += kKeyCellPx) {
    for (int x = 0; x < wide_.width; x += kKeyCellPx) set_tile(x, y);
  }
}

// Of the tile whose first pixel is (x0, y0): how near it is, and how far its inverse depth is from
// what its corners say. The view's cells lie anywhere between the tiles: a step in the middle of a
// tile counts half there, and may count whole in a cell.
void KeyPicture::set_tile(int x0, int y0) {
  const int x1 = std::min(x0 + kKeyCellPx, wide_.width - 1);
  const int y1 = std::min(y0 + kKeyCellPx, wide_.height - 1);
  const auto at = [this](int x, int y) {
    return inverse_depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(wide_.width) +
                          static_cast<std::size_t>(x)];
  };
  const float corner[4] = {at(x0, y0), at(x1, y0), at(x0, y1), at(x1, y1)};
  float largest = 0, error = 0;
  for (int y = y0; y <= y1; ++y) {
    const float down = y1 > y0 ? static_cast<float>(y - y0) / static_cast<float>(y1 - y0) : 0;
    const float left = corner[0] + down * (corner[2] - corner[0]);
    const float right = corner[1] + down * (corner[3] - corner[1]);
    const float step = x1 > x0 ? (right - left) / static_cast<float>(x1 - x0) : 0;
    for (int x = x0; x <= x1; ++x) {
      largest = std::max(largest, at(x, y));
      error = std::max(error, std::abs(at(x, y) - left - step * static_cast<float>(x - x0)));
    }
  }
  // Of the pixel that is nearest to the axis, for which the distance is shortest.
  const Eigen::Vector2d middle(std::clamp(wide_.cx(), 1.0 * x0, 1.0 * x1) - wide_.cx(),
                               std::clamp(wide_.cy(), 1.0 * y0, 1.0 * y1) - wide_.cy());
  const double secant = std::sqrt(1 + middle.squaredNorm() / (wide_.f * wide_.f));
  tile_nearest_[tile(x0 / kKeyCellPx, y0 / kKeyCellPx)] =
      static_cast<float>(largest / secant) * kRoundedUp;
  nearest_inverse_m_ = std::max(nearest_inverse_m_, static_cast<double>(largest));
  // Of the corner that is farthest from the axis.
  const Eigen::Vector2d ray(
      std::max(std::abs(x0 - wide_.cx()), std::abs(x1 - wide_.cx())) / wide_.f,
      std::max(std::abs(y0 - wide_.cy()), std::abs(y1 - wide_.cy())) / wide_.f);
  misplacement_px_per_m_ =
      std::max(misplacement_px_per_m_, 2 * wide_.f * std::sqrt(1 + ray.squaredNorm()) * error);
}

// Whether the camera is still so near that what it drew will do.
bool KeyPicture::near_enough() const {
  const double moved_m = X_KC_.translation().norm();
  if (every_picture_) return X_KC_.isApprox(Eigen::Isometry3d::Identity(), kSamePose);
  const double zoom = moved_m * nearest_inverse_m_;
  return zoom <= max_zoom_ &&
         moved_m * misplacement_px_per_m_ <= max_misplacement_px_ * (1 - zoom) &&
         bend_px() <= kMaxBendPx;
}

// How far the middle of a cell is from where straight lines between its nodes put it, because the
// camera has turned: most in one of the view's corners.
double KeyPicture::bend_px() const {
  const Eigen::Matrix3d direction = directions(view_, X_KC_.linear());
  const auto place = [&](double x, double y) -> Eigen::Vector2d {
    const Eigen::Vector3d ray = direction * Eigen::Vector3d(x, y, 1);
    return view_.f * ray.head<2>() / ray.z();
  };
  constexpr double kCell = kKeyCellPx;
  double bend = 0;
  for (const double x : {0.0, std::max(0.0, view_.width - kCell)}) {
    for (const double y : {0.0, std::max(0.0, view_.height - kCell)}) {
      const Eigen::Vector2d mean = 0.25 * (place(x, y) + place(x + kCell, y) + place(x, y + kCell) +
                                           place(x + kCell, y + kCell));
      bend = std::max(bend, (place(x + 0.5 * kCell, y + 0.5 * kCell) - mean).norm());
    }
  }
  return bend;
}

// Whether the key serves is asked of the whole view: a region shows what a whole picture would.
bool KeyPicture::show(const Eigen::Isometry3d& X_WC, const Rect& region, float* luminance) {
  if (!is_set_) return false;
  X_KC_ = X_KW_ * X_WC;
  if (!near_enough()) return false;
  place_nodes();
  if (!covers_view()) return false;
  const Rect cells = cells_about(region);
  const int size = region.x1 - region.x0, skipped = region.x0 - cells.x0 * kKeyCellPx;
  const bool whole_cells = size == (cells.x1 - cells.x0) * kKeyCellPx;
  for (int y = region.y0; y < region.y1; ++y) {
    float* const shown = luminance + std::ptrdiff_t{y} * view_.width + region.x0;
    read_row(y, cells, whole_cells ? shown : row_.data());
    if (!whole_cells) std::copy_n(row_.data() + skipped, size, shown);
  }
  return true;
}

std::size_t KeyPicture::node(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

std::size_t KeyPicture::tile(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(tile_columns_) +
         static_cast<std::size_t>(column);
}

void KeyPicture::place_nodes() {
  KeyMap map{};
  const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> direction =
      directions(view_, X_KC_.linear()).cast<float>();
  std::copy_n(direction.data(), 9, map.direction);
  const Eigen::Vector3f t = X_KC_.translation().cast<float>();
  std::copy_n(t.data(), 3, map.t);
  map.f = static_cast<float>(wide_.f);
  map.cx = static_cast<float>(wide_.cx());
  map.cy = static_cast<float>(wide_.cy());
  map.last_column = static_cast<float>(wide_.width - 1);
  map.last_row = static_cast<float>(wide_.height - 1);
  map.inverse_depth = inverse_depth_.data();
  map.stride = wide_.width;
  const int rows = static_cast<int>(node_u_.size()) / columns_;
  for (int j = 0; j < rows; ++j) {
    const std::size_t first = node(0, j);
    key_kernels().place(map, 0, kKeyCellPx, static_cast<float>(j * kKeyCellPx), columns_,
                        node_u_.data() + first, node_v_.data() + first);
  }
  // Pixels of the key to places among its means.
  const auto n = static_cast<float>(supersampling_);
  for (float& u : node_u_) u *= n;
  for (float& v : node_v_) v *= n;
}

bool KeyPicture::covers_view() const {
  const auto last_u = static_cast<float>(fine_.width - supersampling_) - kBorderPx;
  const auto last_v = static_cast<float>(fine_.height - supersampling_) - kBorderPx;
  for (std::size_t i = 0; i < node_u_.size(); ++i) {
    const float u = node_u_[i], v = node_v_[i];
    if (!(u >= kBorderPx && u <= last_u && v >= kBorderPx && v <= last_v)) return false;
  }
  return true;
}

// All pixels of the cells in a row of the view.
void KeyPicture::read_row(int row, const Rect& cells, float* luminance) {
  const int j = row / kKeyCellPx;
  const float share = static_cast<float>(row % kKeyCellPx) / kKeyCellPx;
  const std::size_t above = node(cells.x0, j), below = node(cells.x0, j + 1);
  const int count = cells.x1 - cells.x0;
  const CellRow u = {cell_u_.data(), step_u_.data()}, v = {cell_v_.data(), step_v_.data()};
  const KeyKernels& kernels = key_kernels();
  kernels.span(&node_u_[above], &node_u_[below], share, count, u);
  kernels.span(&node_v_[above], &node_v_[below], share, count, v);
  kernels.read(means_.data(), fine_.width, u, v, count, luminance);
}

double KeyPicture::nearest_m(const Rect& region) const {
  const Rect cells = cells_about(region);
  float u0 = std::numeric_limits<float>::max(), v0 = u0, u1 = 0, v1 = 0;
  for (int j = cells.y0; j <= cells.y1; ++j) {
    for (int i = cells.x0; i <= cells.x1; ++i) {
      const std::size_t k = node(i, j);
      u0 = smaller(u0, node_u_[k]), u1 = larger(u1, node_u_[k]);
      v0 = smaller(v0, node_v_[k]), v1 = larger(v1, node_v_[k]);
    }
  }
  const auto tile_at = [this](float place) {
    return static_cast<int>(place) / (kKeyCellPx * supersampling_);
  };
  const int rows = static_cast<int>(tile_nearest_.size()) / tile_columns_;
  const int first = std::max(tile_at(u0) - 1, 0),
            last = std::min(tile_at(u1) + 1, tile_columns_ - 1);
  float nearest = 0;
  for (int y = std::max(tile_at(v0) - 1, 0); y <= std::min(tile_at(v1) + 1, rows - 1); ++y) {
    const float* const row = &tile_nearest_[tile(0, y)];
    for (int x = first; x <= last; ++x) nearest = larger(nearest, row[x]);
  }
  // From the key's place, which the camera has left.
  return 1.0 / static_cast<double>(nearest) - X_KC_.translation().norm();
}

}  // namespace dodgesim
