#include "sim/render/turned_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dodgesim {

namespace {

// Reading between pixels needs two neighbours; rounding may take one more.
constexpr int kBorderPx = 3;

// By value, so that loops over them are vectorised.
inline float smaller(float a, float b) { return a < b ? a : b; }
inline float larger(float a, float b) { return a > b ? a : b; }

// Value half way between b and c of four neighbours: Keys' (1981) cubic with a = -1, whose
// sharpness makes up for what the straight lines between fine points lose. Of a sharp edge it
// shoots over; dark sides do not go below this share of their neighbours, as the logarithm would
// make much of it.
constexpr float kDarkest = 0.8f;
inline float half_way(float a, float b, float c, float d) {
  return larger(0.625f * (b + c) - 0.125f * (a + d), kDarkest * smaller(b, c));
}

// Where the view's pixels lie in a fine picture: homogeneous coordinates, row-major.
struct Homography {
  float h[9];
};

Homography fine_from_view(const Intrinsics& view, const Intrinsics& wide,
                          const Eigen::Matrix3d& R_picture, const Eigen::Matrix3d& R_WC) {
  Eigen::Matrix3d ray;
  ray << 1 / view.f, 0, -view.cx() / view.f, 0, 1 / view.f, -view.cy() / view.f, 0, 0, 1;
  Eigen::Matrix3d fine;
  fine << 2 * wide.f, 0, 2 * wide.cx(), 0, 2 * wide.f, 2 * wide.cy(), 0, 0, 1;
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> h = fine * R_picture.transpose() * R_WC * ray;
  Homography homography;
  for (int i = 0; i < 9; ++i) homography.h[i] = static_cast<float>(h.data()[i]);
  return homography;
}

struct Reading {
  const float* fine;
  int stride, rows;
  Homography map;
};

[[gnu::always_inline]] inline float read(const float* fine, int stride, float last_column,
                                         float last_row, const Homography& map, float x, float y) {
  const float* const h = map.h;
  const float w = 1.0f / (h[6] * x + (h[7] * y + h[8]));
  const float u = smaller(larger((h[0] * x + (h[1] * y + h[2])) * w, 0.0f), last_column);
  const float v = smaller(larger((h[3] * x + (h[4] * y + h[5])) * w, 0.0f), last_row);
  const int column = static_cast<int>(u);
  const int row = static_cast<int>(v);
  const float fu = u - static_cast<float>(column);
  const float fv = v - static_cast<float>(row);
  const int i = row * stride + column;
  const float top = fine[i] + fu * (fine[i + 1] - fine[i]);
  const float bottom = fine[i + stride] + fu * (fine[i + stride + 1] - fine[i + stride]);
  return top + fv * (bottom - top);
}

[[gnu::always_inline]] inline void read_row(const Reading& reading, int row, int width,
                                            float* __restrict out) {
  const float* const fine = reading.fine;
  const Homography map = reading.map;
  const int stride = reading.stride;
  const auto last_column = static_cast<float>(reading.stride - 2);
  const auto last_row = static_cast<float>(reading.rows - 2);
  const auto y = static_cast<float>(row);
  for (int column = 0; column < width; ++column) {
    out[column] = read(fine, stride, last_column, last_row, map, static_cast<float>(column), y);
  }
}

using ReadRow = void (*)(const Reading&, int, int, float*);

void read_row_portable(const Reading& reading, int row, int width, float* out) {
  read_row(reading, row, width, out);
}

#if defined(__x86_64__)
// Without fused multiply-add: the same operations, eight at a time.
[[gnu::target("avx2")]] void read_row_avx2(const Reading& reading, int row, int width, float* out) {
  read_row(reading, row, width, out);
}
#endif

ReadRow fastest_read_row() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return read_row_avx2;
#endif
  return read_row_portable;
}

}  // namespace

Intrinsics with_margin(const Intrinsics& view, int margin_px) {
  return {view.width + 2 * margin_px, view.height + 2 * margin_px, view.f};
}

TurnedPicture::TurnedPicture(const Intrinsics& view, int max_turn_px)
    : margin_px_(max_turn_px + kBorderPx),
      wide_(with_margin(view, margin_px_)),
      luminance_(static_cast<std::size_t>(wide_.width) * static_cast<std::size_t>(wide_.height)),
      fine_(4 * luminance_.size()) {}

void TurnedPicture::set(const Eigen::Matrix3d& R_WC, const std::vector<float>& luminance) {
  R_WC_ = R_WC;
  std::copy(luminance.begin(), luminance.end(), luminance_.begin());
  is_fine_ = false;
}

void TurnedPicture::copy_view(std::vector<float>& luminance) const {
  const std::ptrdiff_t view_width = wide_.width - 2 * margin_px_;
  const std::ptrdiff_t view_height = wide_.height - 2 * margin_px_;
  for (std::ptrdiff_t y = 0; y < view_height; ++y) {
    const auto row = luminance_.begin() + (y + margin_px_) * wide_.width + margin_px_;
    std::copy_n(row, view_width, luminance.begin() + y * view_width);
  }
}

const std::vector<float>& TurnedPicture::fine() {
  if (!is_fine_) refine();
  is_fine_ = true;
  return fine_;
}

void TurnedPicture::refine() {
  const auto width = static_cast<std::size_t>(wide_.width);
  const auto height = static_cast<std::size_t>(wide_.height);
  const std::size_t stride = 2 * width;
  for (std::size_t y = 0; y < height; ++y) {
    const float* const in = luminance_.data() + y * width;
    float* const __restrict out = fine_.data() + 2 * y * stride;
    for (std::size_t x = 0; x < width; ++x) out[2 * x] = in[x];
    for (std::size_t x = 1; x + 2 < width; ++x) {
      out[2 * x + 1] = half_way(in[x - 1], in[x], in[x + 1], in[x + 2]);
    }
    out[1] = in[0];
    out[stride - 3] = in[width - 2];
    out[stride - 1] = in[width - 1];
  }
  for (std::size_t y = 0; y < height; ++y) {
    const float* const b = fine_.data() + 2 * y * stride;
    float* const __restrict out = fine_.data() + (2 * y + 1) * stride;
    if (y < 1 || y + 2 >= height) {
      std::copy_n(b, stride, out);
      continue;
    }
    const float* const a = b - 2 * stride;
    const float* const c = b + 2 * stride;
    const float* const d = c + 2 * stride;
    for (std::size_t x = 0; x < stride; ++x) out[x] = half_way(a[x], b[x], c[x], d[x]);
  }
}

void turn(const Intrinsics& view, TurnedPicture& picture, const Eigen::Matrix3d& R_WC,
          std::vector<float>& luminance) {
  static const ReadRow read_row = fastest_read_row();
  const Reading reading{picture.fine().data(), picture.fine_width(),
                        2 * picture.intrinsics().height,
                        fine_from_view(view, picture.intrinsics(), picture.R_WC(), R_WC)};
  for (int row = 0; row < view.height; ++row) {
    read_row(reading, row, view.width, luminance.data() + std::ptrdiff_t{row} * view.width);
  }
}

void blend_turned(const Intrinsics& view, TurnedPicture& a, TurnedPicture& b,
                  const Eigen::Matrix3d& R_WC, double share_b, std::vector<float>& scratch,
                  std::vector<float>& luminance) {
  turn(view, a, R_WC, luminance);
  turn(view, b, R_WC, scratch);
  const auto share = static_cast<float>(share_b);
  for (std::size_t i = 0; i < luminance.size(); ++i) {
    luminance[i] += share * (scratch[i] - luminance[i]);
  }
}

}  // namespace dodgesim
