#include "sim/render/key_kernels.h"

#include <array>
#include <bit>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "sim/base/branchless.h"
#include "sim/base/vector_level.h"

namespace dodgesim {

namespace {

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

[[gnu::always_inline]] inline void halve_row(const float* __restrict values, int size,
                                             std::uint16_t* __restrict halves) {
  for (int i = 0; i < size; ++i) halves[i] = static_cast<std::uint16_t>(to_half(values[i]));
}

[[gnu::always_inline]] inline void means_row(const float* rows, int stride, int n, int size,
                                             float* __restrict sums, float* __restrict means) {
  for (int i = 0; i < size; ++i) sums[i] = rows[i];
  for (int k = 1; k < n; ++k) {
    const float* const __restrict row = rows + std::ptrdiff_t{k} * stride;
    for (int i = 0; i < size; ++i) sums[i] += row[i];
  }
  const int count = size - n + 1;
  for (int i = 0; i < count; ++i) means[i] = sums[i];
  for (int k = 1; k < n; ++k) {
    for (int i = 0; i < count; ++i) means[i] += sums[i + k];
  }
  const float share = 1.0f / static_cast<float>(n * n);
  for (int i = 0; i < count; ++i) means[i] *= share;
}

// Straight lines between means take from a wave, on the average over all places between them, what
// this gives it first (the series of 1/sinc^2). Next to an edge it would go too far below the dark
// side, of which the logarithm makes much; so it stops at this share of its neighbours.
constexpr float kSharpening = 1.0f / 12;
constexpr float kDarkest = 0.95f;

[[gnu::always_inline]] inline float sharpened(float before, float here, float after) {
  const float sharp = here + kSharpening * (2 * here - before - after);
  return larger(sharp, kDarkest * smaller(here, smaller(before, after)));
}

[[gnu::always_inline]] inline void sharpen_row(const float* __restrict above,
                                               const float* __restrict row,
                                               const float* __restrict below, int size,
                                               float* __restrict across, float* __restrict sharp) {
  for (int i = 0; i < size; ++i) across[i] = sharpened(above[i], row[i], below[i]);
  for (int i = 1; i + 1 < size; ++i) {
    sharp[i] = sharpened(across[i - 1], across[i], across[i + 1]);
  }
  sharp[0] = across[0];
  sharp[size - 1] = across[size - 1];
}

[[gnu::always_inline]] inline void largest_of_blocks(const float* rows, int stride, int n,
                                                     int blocks, float* __restrict out) {
  for (int i = 0; i < blocks; ++i) out[i] = 0;
  for (int k = 0; k < n * n; ++k) {
    const float* const __restrict row = rows + std::ptrdiff_t{k / n} * stride + k % n;
    for (int i = 0; i < blocks; ++i) out[i] = larger(out[i], row[std::ptrdiff_t{i} * n]);
  }
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
    const float inverse_dz = 1.0f / dz;
    const float right = dx * inverse_dz, down = dy * inverse_dz;
    const float right_by = m.t[0] - m.t[2] * right, down_by = m.t[1] - m.t[2] * down;
    float x = m.f * right + m.cx;
    float y = m.f * down + m.cy;
    for (int k = 0; k < kDepthReadings; ++k) {
      // Neither is negative; lround would be a call.
      // NOLINTBEGIN(bugprone-incorrect-roundings)
      const int at_x = static_cast<int>(smaller(larger(x, 0.0f), m.last_column) + 0.5f);
      const int at_y = static_cast<int>(smaller(larger(y, 0.0f), m.last_row) + 0.5f);
      // NOLINTEND(bugprone-incorrect-roundings)
      // The point along the ray from the camera's place whose z in the key is 1/rho, over its z.
      const float rho = inverse_depth[at_y * m.stride + at_x];
      x = m.f * (right + rho * right_by) + m.cx;
      y = m.f * (down + rho * down_by) + m.cy;
    }
    x_out[i] = dz > 0.0f ? x : -1.0f;
    y_out[i] = y;
  }
}

[[gnu::always_inline]] inline void span_row(const float* __restrict above,
                                            const float* __restrict below, float share, int cells,
                                            CellRow row) {
  float* const __restrict first = row.first;
  float* const __restrict step = row.step;
  for (int cell = 0; cell < cells; ++cell) {
    const float left = above[cell] + share * (below[cell] - above[cell]);
    const float right = above[cell + 1] + share * (below[cell + 1] - above[cell + 1]);
    first[cell] = left;
    step[cell] = (right - left) * (1.0f / kKeyCellPx);
  }
}

void read_portable(const std::uint16_t* means, int stride, CellRow u, CellRow v, int cells,
                   float* luminance) {
  for (int i = 0; i < cells * kKeyCellPx; ++i) {
    const int cell = i / kKeyCellPx;
    const auto pixel = static_cast<float>(i % kKeyCellPx);
    const float at_u = u.first[cell] + u.step[cell] * pixel;
    const float at_v = v.first[cell] + v.step[cell] * pixel;
    const int column = static_cast<int>(at_u);
    const int row = static_cast<int>(at_v);
    const float fu = at_u - static_cast<float>(column);
    const float fv = at_v - static_cast<float>(row);
    const std::uint16_t* const top = means + row * stride + column;
    const std::uint16_t* const bottom = top + stride;
    const float a = from_half(top[0]), b = from_half(top[1]);
    const float c = from_half(bottom[0]), d = from_half(bottom[1]);
    const float upper = a + fu * (b - a);
    const float lower = c + fu * (d - c);
    luminance[i] = upper + fv * (lower - upper);
  }
}

#if defined(__x86_64__)
// With the default supersampling the camera's next row lies so many rows of means below.
constexpr int kNextRow = 3;

// The same operations, eight or sixteen pixels at a time: compilers know no loads of 16 bits from
// many places. One load of 32 bits takes a mean and its right neighbour.

DODGESIM_TARGET_AVX2 inline __m256 numbers(__m256i halves) {
  return _mm256_mul_ps(_mm256_castsi256_ps(_mm256_slli_epi32(halves, kMantissaBits)),
                       _mm256_set1_ps(kMore));
}

DODGESIM_TARGET_AVX2 inline __m256 between(__m256 a, __m256 b, __m256 share) {
  return _mm256_add_ps(a, _mm256_mul_ps(share, _mm256_sub_ps(b, a)));
}

// A cell.
DODGESIM_TARGET_AVX2 inline __m256 coordinates_of_cell(CellRow row, int cell) {
  const __m256 pixel = _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7);
  return _mm256_add_ps(_mm256_set1_ps(row.first[cell]),
                       _mm256_mul_ps(_mm256_set1_ps(row.step[cell]), pixel));
}

DODGESIM_TARGET_AVX2 inline __m128i four_pairs(const std::uint16_t* means, const int* places) {
  const __m128i a = _mm_loadu_si32(means + places[0]), b = _mm_loadu_si32(means + places[1]);
  const __m128i c = _mm_loadu_si32(means + places[2]), d = _mm_loadu_si32(means + places[3]);
  return _mm_unpacklo_epi64(_mm_unpacklo_epi32(a, b), _mm_unpacklo_epi32(c, d));
}

// What a gather would load; in less time on AMD's processors, on Intel's nobody has measured it.
DODGESIM_TARGET_AVX2 inline __m256i eight_pairs(const std::uint16_t* means, const int* places) {
  return _mm256_set_m128i(four_pairs(means, places + 4), four_pairs(means, places));
}

DODGESIM_TARGET_AVX2 void read_avx2(const std::uint16_t* means, int stride, CellRow u, CellRow v,
                                    int cells, float* luminance) {
  static_assert(kKeyCellPx == 8);
  const __m256i low = _mm256_set1_epi32(0xffff);
  for (int cell = 0; cell < cells; ++cell) {
    const __m256 at_u = coordinates_of_cell(u, cell), at_v = coordinates_of_cell(v, cell);
    const __m256i column = _mm256_cvttps_epi32(at_u), row = _mm256_cvttps_epi32(at_v);
    const __m256 fu = _mm256_sub_ps(at_u, _mm256_cvtepi32_ps(column));
    const __m256 fv = _mm256_sub_ps(at_v, _mm256_cvtepi32_ps(row));
    const __m256i at = _mm256_add_epi32(_mm256_mullo_epi32(row, _mm256_set1_epi32(stride)), column);
    alignas(32) int places[kKeyCellPx];
    _mm256_store_si256(reinterpret_cast<__m256i*>(places), at);
    // The camera's next row but one: what the next one needs would come too late.
    for (const int place : {places[0], places[kKeyCellPx - 1]}) {
      const std::uint16_t* const later = means + place + 2 * kNextRow * stride;
      _mm_prefetch(later, _MM_HINT_T0);
      _mm_prefetch(later + stride, _MM_HINT_T0);
    }
    const __m256i top = eight_pairs(means, places);
    const __m256i bottom = eight_pairs(means + stride, places);
    const __m256 upper =
        between(numbers(_mm256_and_si256(top, low)), numbers(_mm256_srli_epi32(top, 16)), fu);
    const __m256 lower =
        between(numbers(_mm256_and_si256(bottom, low)), numbers(_mm256_srli_epi32(bottom, 16)), fu);
    _mm256_storeu_ps(luminance + cell * kKeyCellPx, between(upper, lower, fv));
  }
}

DODGESIM_TARGET_AVX512 inline __m512 numbers(__m512i halves) {
  return _mm512_mul_ps(_mm512_castsi512_ps(_mm512_slli_epi32(halves, kMantissaBits)),
                       _mm512_set1_ps(kMore));
}

DODGESIM_TARGET_AVX512 inline __m512 between(__m512 a, __m512 b, __m512 share) {
  return _mm512_add_ps(a, _mm512_mul_ps(share, _mm512_sub_ps(b, a)));
}

// Where sixteen pixels lie among the means.
struct Places {
  __m512i column, row;
  __m512 fu, fv;
};

// The means at the places and their right neighbours, one pair in 32 bits.
struct Corners {
  __m512i top, bottom;
};

// One number for each of two cells.
DODGESIM_TARGET_AVX512 inline __m512 of_cells(const float* values) {
  return _mm512_insertf32x8(_mm512_set1_ps(values[0]), _mm256_set1_ps(values[1]), 1);
}

DODGESIM_TARGET_AVX512 inline __m512 coordinates_of_cells(CellRow row, int cell) {
  const __m512 pixel = _mm512_setr_ps(0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7);
  return _mm512_add_ps(of_cells(row.first + cell), _mm512_mul_ps(of_cells(row.step + cell), pixel));
}

DODGESIM_TARGET_AVX512 inline Places places_of(__m512 u, __m512 v) {
  const __m512i column = _mm512_cvttps_epi32(u), row = _mm512_cvttps_epi32(v);
  return {column, row, _mm512_sub_ps(u, _mm512_cvtepi32_ps(column)),
          _mm512_sub_ps(v, _mm512_cvtepi32_ps(row))};
}

DODGESIM_TARGET_AVX512 inline Corners gathered(const std::uint16_t* means, int stride,
                                               const Places& p) {
  const __m512i at =
      _mm512_add_epi32(_mm512_mullo_epi32(p.row, _mm512_set1_epi32(stride)), p.column);
  return {_mm512_i32gather_epi32(at, means, 2), _mm512_i32gather_epi32(at, means + stride, 2)};
}

constexpr int kReach = 64;

// The same as gathered(), on AMD's processors in a fraction of its time, if the pixels lie in
// `rows` rows from `row` on and within kReach means from `column` on; false if they do not.
DODGESIM_TARGET_AVX512 inline bool pick(const std::uint16_t* means, int stride, const Places& p,
                                        int row, int rows, int column, Corners& corners) {
  const __m512i right = _mm512_sub_epi32(p.column, _mm512_set1_epi32(column));
  const __m512i down = _mm512_sub_epi32(p.row, _mm512_set1_epi32(row));
  if (_mm512_cmplt_epu32_mask(right, _mm512_set1_epi32(kReach - 1)) != 0xffff ||
      _mm512_cmplt_epu32_mask(down, _mm512_set1_epi32(rows)) != 0xffff) {
    return false;
  }
  // In the halves of each 32 bits the numbers of a mean and of its right neighbour.
  const __m512i pairs = _mm512_add_epi32(_mm512_or_si512(right, _mm512_slli_epi32(right, 16)),
                                         _mm512_set1_epi32(1 << 16));
  const std::uint16_t* at = means + row * stride + column;
  __mmask16 above = 0;
  corners = {_mm512_setzero_si512(), _mm512_setzero_si512()};
  for (int n = 0; n <= rows; ++n, at += stride) {
    const __m512i picked = _mm512_permutex2var_epi16(_mm512_loadu_si512(at), pairs,
                                                     _mm512_loadu_si512(at + kReach / 2));
    corners.bottom = _mm512_mask_mov_epi32(corners.bottom, above, picked);
    above = _mm512_cmpeq_epi32_mask(down, _mm512_set1_epi32(n));
    corners.top = _mm512_mask_mov_epi32(corners.top, above, picked);
  }
  // What the camera's next row needs besides.
  const int first = larger(kNextRow, rows + 1);
  at = means + (row + first) * stride + column;
  for (int n = first; n <= kNextRow + rows; ++n, at += stride) {
    _mm_prefetch(at, _MM_HINT_T0);
    _mm_prefetch(at + kReach / 2, _MM_HINT_T0);
  }
  return true;
}

// Of the last pixel of the second of two cells.
inline float last_of_cells(CellRow row, int cell) {
  return row.first[cell + 1] + row.step[cell + 1] * (kKeyCellPx - 1);
}

template <bool kGathers>
DODGESIM_TARGET_AVX512 void read_avx512(const std::uint16_t* means, int stride, CellRow u,
                                        CellRow v, int cells, float* luminance) {
  constexpr int kCells = 2;
  constexpr int kMostRows = kGathers ? 0 : kKeySpareRows;  // more take longer than to gather
  const __m512i low = _mm512_set1_epi32(0xffff);
  int cell = 0;
  for (; cell + kCells <= cells; cell += kCells) {
    const Places p = places_of(coordinates_of_cells(u, cell), coordinates_of_cells(v, cell));
    // Places run nearly straight: those at the ends say which rows and columns are needed.
    const float v0 = v.first[cell], v1 = last_of_cells(v, cell);
    const int row = static_cast<int>(smaller(v0, v1));
    const int rows = static_cast<int>(larger(v0, v1)) - row + 1;
    const int column = static_cast<int>(smaller(u.first[cell], last_of_cells(u, cell)));
    Corners c = {_mm512_setzero_si512(), _mm512_setzero_si512()};
    if (rows > kMostRows || !pick(means, stride, p, row, rows, column, c)) {
      c = gathered(means, stride, p);
      const std::uint16_t* const next = means + (row + kNextRow) * stride + column;
      for (int n = 0; n < 2; ++n) {
        _mm_prefetch(next + n * stride, _MM_HINT_T0);
        _mm_prefetch(next + n * stride + kReach / 2, _MM_HINT_T0);
      }
    }
    const __m512 upper =
        between(numbers(_mm512_and_si512(c.top, low)), numbers(_mm512_srli_epi32(c.top, 16)), p.fu);
    const __m512 lower = between(numbers(_mm512_and_si512(c.bottom, low)),
                                 numbers(_mm512_srli_epi32(c.bottom, 16)), p.fu);
    _mm512_storeu_ps(luminance + cell * kKeyCellPx, between(upper, lower, p.fv));
  }
  _mm256_zeroupper();  // GCC 12 forgets it here; all code without AVX is slow then
  read_portable(means, stride, {u.first + cell, u.step + cell}, {v.first + cell, v.step + cell},
                cells - cell, luminance + cell * kKeyCellPx);
}
#else
constexpr auto read_avx2 = read_portable;
template <bool kGathers>
constexpr auto read_avx512 = read_portable;
#endif

constexpr KeyKernels kernels(int level, decltype(KeyKernels::read) read) {
  return {compiled_for<means_row>(level),
          compiled_for<sharpen_row>(level),
          compiled_for<largest_of_blocks>(level),
          compiled_for<halve_row>(level),
          compiled_for<place_row>(level),
          compiled_for<span_row>(level),
          read};
}

constexpr std::array<KeyKernels, kVectorLevels> kKernels = {kernels(kPortable, read_portable),
                                                            kernels(kAvx2, read_avx2),
                                                            kernels(kAvx512, read_avx512<true>)};
constexpr KeyKernels kWithoutGathers = kernels(kAvx512, read_avx512<false>);

// Those of Intel's processors are quick, those of AMD's are not.
bool gathers_are_quick() {
#if defined(__x86_64__)
  return __builtin_cpu_is("intel") != 0;
#else
  return false;
#endif
}

}  // namespace

const KeyKernels& key_kernels(int vector_level, bool gathers) {
  if (vector_level == kAvx512 && !gathers) return kWithoutGathers;
  return kKernels[static_cast<std::size_t>(vector_level)];
}

const KeyKernels& key_kernels() {
  static const KeyKernels& fastest = key_kernels(vector_level(), gathers_are_quick());
  return fastest;
}

}  // namespace dodgesim
