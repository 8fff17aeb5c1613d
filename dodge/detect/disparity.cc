#include "dodge/detect/disparity.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

namespace dodge {

namespace {

// An image with less than this part of the pattern's energy is not scaled up to the pattern: faint
// noise may have the right shape.
constexpr double kLeastEnergy = 0.25;

double normalised(double product, double pattern_energy, double image_energy) {
  if (product <= 0) return 0;
  return product /
         std::sqrt(pattern_energy * std::max(image_energy, kLeastEnergy * pattern_energy));
}

double correlation(const cv::Mat1f& pattern, const cv::Rect& patch, const cv::Mat1f& image,
                   int shift) {
  double product = 0, pattern_energy = 0, image_energy = 0;
  for (int y = patch.y; y < patch.y + patch.height; ++y) {
    const float* a = pattern.ptr<float>(y);
    const int row = y + shift;
    const float* b = row >= 0 && row < image.rows ? image.ptr<float>(row) : nullptr;
    float row_product = 0, row_pattern = 0, row_image = 0;
    for (int x = patch.x; x < patch.x + patch.width; ++x) {
      const float p = std::max(0.0F, a[x]);
      row_pattern += p * p;
      if (b == nullptr) continue;
      const float q = std::max(0.0F, b[x]);
      row_product += p * q;
      row_image += q * q;
    }
    product += row_product;
    pattern_energy += row_pattern;
    image_energy += row_image;
  }
  return normalised(product, pattern_energy, image_energy);
}

// The positive part of a row's pixels within the columns of `patch`.
auto positive(const cv::Mat1f& image, int row, const cv::Rect& patch) {
  return Eigen::Map<const Eigen::VectorXf>(image.ptr<float>(row) + patch.x, patch.width)
      .cwiseMax(0.0F);
}

cv::Rect within_both(const cv::Rect& patch, const cv::Mat1f& pattern, const cv::Mat1f& image) {
  return patch & cv::Rect(0, 0, std::min(pattern.cols, image.cols), pattern.rows);
}

}  // namespace

std::optional<RowShift> find_row_shift(const cv::Mat1f& pattern, const cv::Rect& patch,
                                       const cv::Mat1f& image, int min_shift_px, int max_shift_px) {
  const cv::Rect inside = within_both(patch, pattern, image);
  int best_shift = 0;
  double best = 0;
  for (int shift = min_shift_px; shift <= max_shift_px; ++shift) {
    const double value = correlation(pattern, inside, image, shift);
    if (value > best) {
      best = value;
      best_shift = shift;
    }
  }
  if (best <= 0) return std::nullopt;
  double before = correlation(pattern, inside, image, best_shift - 1);
  double after = correlation(pattern, inside, image, best_shift + 1);
  while (before > best) {  // uphill, beyond what was searched
    after = std::exchange(best, before);
    before = correlation(pattern, inside, image, --best_shift - 1);
  }
  while (after > best) {
    before = std::exchange(best, after);
    after = correlation(pattern, inside, image, ++best_shift + 1);
  }
  // The vertex of the parabola through the best value and its neighbours.
  const double curvature = before - 2 * best + after;
  const double offset =
      curvature < 0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0;
  return RowShift{best_shift + offset, best};
}

// correlation() of some 240 shifts, many of its sums at once; the image's energy slides along.
double best_correlation(const cv::Mat1f& pattern, const cv::Rect& patch, const cv::Mat1f& image,
                        int min_shift_px, int max_shift_px) {
  const cv::Rect inside = within_both(patch, pattern, image);
  const int top = inside.y, bottom = inside.y + inside.height;
  const auto image_energy_of = [&](int row) {
    if (row < 0 || row >= image.rows) return 0.0;
    return static_cast<double>(positive(image, row, inside).squaredNorm());
  };
  double pattern_energy = 0, image_energy = 0;
  for (int y = top; y < bottom; ++y) {
    pattern_energy += positive(pattern, y, inside).squaredNorm();
    image_energy += image_energy_of(y + min_shift_px);
  }
  double best = 0;
  for (int shift = min_shift_px; shift <= max_shift_px; ++shift) {
    double product = 0;
    for (int y = std::max(top, -shift); y < std::min(bottom, image.rows - shift); ++y) {
      product += positive(pattern, y, inside).dot(positive(image, y + shift, inside));
    }
    best = std::max(best, normalised(product, pattern_energy, image_energy));
    image_energy += image_energy_of(bottom + shift) - image_energy_of(top + shift);
  }
  return best;
}

}  // namespace dodge
