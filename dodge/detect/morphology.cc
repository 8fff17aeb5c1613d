#include "dodge/detect/morphology.h"

#include <algorithm>

namespace dodge {

namespace {

struct Least {
  static constexpr std::uint8_t kNeutral = 255;
  static constexpr bool kZeroWins = true;
  static std::uint8_t of(std::uint8_t a, std::uint8_t b) { return a < b ? a : b; }
};

struct Greatest {
  static constexpr std::uint8_t kNeutral = 0;
  static constexpr bool kZeroWins = false;
  static std::uint8_t of(std::uint8_t a, std::uint8_t b) { return a > b ? a : b; }
};

template <class Extreme>
void take_in(const std::uint8_t* row, int width, std::uint8_t* __restrict extreme) {
  for (int x = 0; x < width; ++x) extreme[x] = Extreme::of(extreme[x], row[x]);
}

bool is_zero(const std::uint8_t* row, int width) {
  std::uint8_t any = 0;
  for (int x = 0; x < width; ++x) any = static_cast<std::uint8_t>(any | row[x]);
  return any == 0;
}

}  // namespace

Morphology::Morphology(int width_px, int height_px, int max_size_px)
    : width_(width_px),
      height_(height_px),
      padded_(static_cast<std::size_t>(width_px + std::max(0, max_size_px - 1))),
      rows_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      empty_(static_cast<std::size_t>(height_px)) {}

void Morphology::erode(cv::Mat1b& image, int size_px, int anchor_px) {
  filter<Least>(image, size_px, anchor_px);
}

void Morphology::dilate(cv::Mat1b& image, int size_px, int anchor_px) {
  filter<Greatest>(image, size_px, anchor_px);
}

// Along x, then along y.
template <class Extreme>
void Morphology::filter(cv::Mat1b& image, int size_px, int anchor_px) {
  std::fill(padded_.begin(), padded_.end(), Extreme::kNeutral);
  for (int y = 0; y < height_; ++y) {
    const std::uint8_t* in = image.ptr<std::uint8_t>(y);
    const bool empty = is_zero(in, width_);
    empty_[static_cast<std::size_t>(y)] = empty ? 1 : 0;
    if (empty) continue;
    std::copy_n(in, width_, padded_.data() + anchor_px);
    std::copy_n(padded_.data(), width_, row(y));
    for (int i = 1; i < size_px; ++i) take_in<Extreme>(padded_.data() + i, width_, row(y));
  }
  for (int y = 0; y < height_; ++y) {
    std::uint8_t* out = image.ptr<std::uint8_t>(y);
    const int begin = std::max(0, y - anchor_px), end = std::min(height_, y - anchor_px + size_px);
    const auto empty_rows = std::count(empty_.begin() + begin, empty_.begin() + end, 1);
    if (empty_rows == end - begin || (Extreme::kZeroWins && empty_rows > 0)) {
      std::fill_n(out, width_, std::uint8_t{0});
      continue;
    }
    std::fill_n(out, width_, Extreme::kNeutral);
    for (int v = begin; v < end; ++v) {
      if (empty_[static_cast<std::size_t>(v)] == 0) take_in<Extreme>(row(v), width_, out);
    }
  }
}

}  // namespace dodge
