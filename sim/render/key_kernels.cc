#include "sim/render/key_kernels.h"

#include <array>
#include <bit>

#include "sim/base/vector_level.h"

namespace dodgesim {

namespace {

// By value, so that loops over them are vectorised. Not a number becomes the bound.
inline float smaller(float a, float b) { return a < b ? a : b; }
inline float larger(float a, float b) { return a > b ? a : b; }

// The exponents of half and single precision differ by 112, their mantissas by 13 bits.
constexpr float kFewer = 0x1p-112f, kMore = 0x1p112f;
constexpr int kMantissaBits = 13;

[[gnu::always_inline]] inline std::uint32_t to_half(float value) {
  const float bounded = smaller(larger(value, 0.0f), kLargestHalf);
  return (std::bit_cast<std::uint32_t>(bounded * kFewer) + (1u << (kMantissaBits - 1))) >>
         kMantissaBits;
}

[[gnu::always_inline]] inline float from_half(std::uint32_t half) {
  return std::bit_cast<float>(half << kMantissaBits) * kMore;
}

[[gnu::always_inline]] inline void pack_row(const float* __restrict means, int size,
                                            std::uint32_t* __restrict pairs) {
  for (int i = 0; i + 1 < size; ++i) pairs[i] = to_half(means[i]) | to_half(means[i + 1]) << 16;
}

// Fixed-point iterations from the direction alone: each reads the depth where the last one led.
constexpr int kDepthReadings = 3;

[[gnu::always_inline]] inline void place_row(const KeyMap& map, float column, float step, float row,
                                             int size, float* __restrict x_out,
                                             float* __restrict y_out) {
  const KeyMap m = map;
  const float* const __restrict inverse_depth = map.inverse_depth;
  for (int i = 0; i < size; ++i) {
    const float c = column + step * static_cast<float>(i);
    const float dx = m.direction[0] * c + (m.direction[1] * row + m.direction[2]);
    const float dy = m.direction[3] * c + (m.direction[4] * row + m.direction[5]);
    const float dz = m.direction[6] * c + (m.direction[7] * row + m.direction[8]);
    float x = m.f * (dx / dz) + m.cx;
    float y = m.f * (dy / dz) + m.cy;
    for (int k = 0; k < kDepthReadings; ++k) {
      const int at_x = static_cast<int>(smaller(larger(x, 0.0f), m.last_column) + 0.5f);
      const int at_y = static_cast<int>(smaller(larger(y, 0.0f), m.last_row) + 0.5f);
      const float rho = inverse_depth[at_y * m.stride + at_x];
      // 1/z of the point along the ray from the camera's place, whose z in the key is 1/rho.
      const float mu = dz * rho / (1.0f - m.t[2] * rho);
      const float z = dz + m.t[2] * mu;
      x = m.f * ((dx + m.t[0] * mu) / z) + m.cx;
      y = m.f * ((dy + m.t[1] * mu) / z) + m.cy;
    }
    x_out[i] = dz > 0.0f ? x : -1.0f;
    y_out[i] = y;
  }
}

[[gnu::always_inline]] inline void spread_row(const float* __restrict above,
                                              const float* __restrict below, float share, int cells,
                                              float* __restrict out) {
  for (int cell = 0; cell < cells; ++cell) {
    const float left = above[cell] + share * (below[cell] - above[cell]);
    const float right = above[cell + 1] + share * (below[cell + 1] - above[cell + 1]);
    const float step = (right - left) * (1.0f / kKeyCellPx);
    for (int i = 0; i < kKeyCellPx; ++i) {
      out[cell * kKeyCellPx + i] = left + step * static_cast<float>(i);
    }
  }
}

[[gnu::always_inline]] inline void read_row(const std::uint32_t* __restrict pairs, int stride,
                                            const float* __restrict u, const float* __restrict v,
                                            int size, float* __restrict luminance) {
  constexpr std::uint32_t kLow = 0xffff;
  for (int i = 0; i < size; ++i) {
    const int column = static_cast<int>(u[i]);
    const int row = static_cast<int>(v[i]);
    const float fu = u[i] - static_cast<float>(column);
    const float fv = v[i] - static_cast<float>(row);
    const int at = row * stride + column;
    const std::uint32_t top = pairs[at], bottom = pairs[at + stride];
    const float a = from_half(top & kLow), b = from_half(top >> 16);
    const float c = from_half(bottom & kLow), d = from_half(bottom >> 16);
    const float upper = a + fu * (b - a);
    const float lower = c + fu * (d - c);
    luminance[i] = upper + fv * (lower - upper);
  }
}

// One set of functions a level.
#define DODGESIM_KEY_KERNELS(suffix, target)                                                   \
  target void pack_##suffix(const float* means, int size, std::uint32_t* pairs) {              \
    pack_row(means, size, pairs);                                                              \
  }                                                                                            \
  target void place_##suffix(const KeyMap& map, float column, float step, float row, int size, \
                             float* x, float* y) {                                             \
    place_row(map, column, step, row, size, x, y);                                             \
  }                                                                                            \
  target void spread_##suffix(const float* above, const float* below, float share, int cells,  \
                              float* out) {                                                    \
    spread_row(above, below, share, cells, out);                                               \
  }                                                                                            \
  target void read_##suffix(const std::uint32_t* pairs, int stride, const float* u,            \
                            const float* v, int size, float* luminance) {                      \
    read_row(pairs, stride, u, v, size, luminance);                                            \
  }                                                                                            \
  constexpr KeyKernels k_##suffix = {pack_##suffix, place_##suffix, spread_##suffix, read_##suffix}

DODGESIM_KEY_KERNELS(portable, );
DODGESIM_KEY_KERNELS(avx2, DODGESIM_TARGET_AVX2);
DODGESIM_KEY_KERNELS(avx512, DODGESIM_TARGET_AVX512);

#undef DODGESIM_KEY_KERNELS

constexpr std::array<KeyKernels, kVectorLevels> kKernels = {k_portable, k_avx2, k_avx512};

}  // namespace

const KeyKernels& key_kernels(int vector_level) {
  return kKernels[static_cast<std::size_t>(vector_level)];
}

const KeyKernels& key_kernels() {
  static const int level = widest_vector_level();
  return key_kernels(level);
}

}  // namespace dodgesim
