#include "dodge/detect/binomial_filter.h"

#include <algorithm>
#include <cmath>

namespace dodge {

namespace {

std::vector<float> binomial_weights(int radius) {
  const int order = 2 * radius;
  std::vector<float> weights(static_cast<std::size_t>(radius + 1));
  float binomial = 1;
  for (int i = 0; i <= radius; ++i) {
    weights[static_cast<std::size_t>(radius - i)] = std::ldexp(binomial, -order);
    binomial = binomial * static_cast<float>(order - i) / static_cast<float>(i + 1);
  }
  return weights;
}

// The weighted sum of a line of pixels, line(0), and of those at both sides of it, line(-1),
// line(1), line(-2) ...
template <class Line>
void weighted_sum(const std::vector<float>& weights, int width, Line line, float* __restrict out) {
  const float* centre = line(0);
  if (weights.size() == 1) {
    std::copy_n(centre, width, out);
    return;
  }
  const float w0 = weights[0], w1 = weights[1];
  const float *left = line(-1), *right = line(1);
  for (int x = 0; x < width; ++x) out[x] = w0 * centre[x] + w1 * (left[x] + right[x]);
  for (int i = 2; i < static_cast<int>(weights.size()); ++i) {
    const float *before = line(-i), *after = line(i);
    const float w = weights[static_cast<std::size_t>(i)];
    for (int x = 0; x < width; ++x) out[x] += w * (before[x] + after[x]);
  }
}

}  // namespace

BinomialFilter::BinomialFilter(int size_px, int width_px)
    : radius_(size_px / 2),
      width_(width_px),
      weights_(binomial_weights(radius_)),
      padded_(static_cast<std::size_t>(width_px + 2 * radius_)),
      rows_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(2 * radius_ + 1)) {}

void BinomialFilter::apply(const cv::Mat1f& image, cv::Mat1f& out) {
  std::fill(rows_.begin(), rows_.end(), 0.0F);  // what is above the image
  for (int newest = 0; newest < image.rows + radius_; ++newest) {
    if (newest < image.rows) {
      std::copy_n(image.ptr<float>(newest), width_, padded_.data() + radius_);
    } else {
      std::fill(padded_.begin(), padded_.end(), 0.0F);
    }
    weighted_sum(
        weights_, width_, [&](int i) { return padded_.data() + radius_ + i; },
        averaged_along_x(newest));
    const int y = newest - radius_;
    if (y < 0) continue;
    weighted_sum(
        weights_, width_, [&](int i) { return averaged_along_x(y + i); }, out.ptr<float>(y));
  }
}

float* BinomialFilter::averaged_along_x(int y) {
  const int count = 2 * radius_ + 1;
  return rows_.data() + static_cast<std::ptrdiff_t>((y + count) % count) * width_;
}

}  // namespace dodge
