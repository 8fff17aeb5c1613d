// The hot loops of key_picture.h, compiled for each width of vectors (see sim/base/vector_level.h).
// All give the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dodgesim {

inline constexpr float kLargestHalf = 65504;

// Maps view pixels to a key, up to the depth: with d = direction of a pixel's ray, its point lies
// at d + t times its inverse distance along the ray.
struct KeyMap {
  float direction[9];  // (column, row, 1) of the view to d in the key's frame, row-major
  float t[3];          // the camera's place in the key's frame [m]
  float f, cx, cy;     // of the key's depth [px]
  float last_column, last_row;
  const float* inverse_depth;  // [1/m]
  int stride;                  // of inverse_depth
};

inline constexpr int kKeyCellPx = 8;
inline constexpr int kKeySpareRows = 16;
inline constexpr int kKeySpareMeans = 64;

// Coordinates of the pixels in a row of cells: pixel i of a cell lies at first + i * step.
struct CellRow {
  float *first, *step;
};

struct KeyKernels {
  // Means over n x n values: those that begin at each of the first size - n + 1 values of the first
  // of n rows of `size` values, which lie `stride` values apart. `sums` is scratch for `size`.
  void (*means)(const float* rows, int stride, int n, int size, float* sums, float* means);
  // A row of means, from the rows above it, of it and below it: what is lost between means that are
  // joined by straight lines, on the average, is put in before. `across` is scratch for `size`.
  void (*sharpen)(const float* above, const float* row, const float* below, int size, float* across,
                  float* sharp);
  // The largest of blocks of n x n values side by side, none of which is negative.
  void (*largest)(const float* rows, int stride, int n, int blocks, float* largest);
  // Half precision (IEEE 754 binary16), rounded half up; of numbers from 0 to kLargestHalf.
  void (*halve)(const float* values, int size, std::uint16_t* halves);
  // Where view pixels (column, row), (column + step, row), ... lie in the key's depth [px].
  void (*place)(const KeyMap& map, float column, float step, float row, int size, float* x,
                float* y);
  // A row of `cells` cells between `cells` + 1 nodes, which lie at `share` of the way from `above`
  // to `below`: where each cell's first pixel lies, and the step from pixel to pixel.
  void (*span)(const float* above, const float* below, float share, int cells, CellRow row);
  // Reads `means` (half precision) at all pixels of a row of cells, whose columns and rows among
  // the means are u and v, linearly in between. kKeySpareRows rows, and no fewer than
  // kKeySpareMeans means, must follow the last one that is needed; what is in them does not matter.
  void (*read)(const std::uint16_t* means, int stride, CellRow u, CellRow v, int cells,
               float* luminance);
};

const KeyKernels& key_kernels();  // the fastest
// This processor must have the level. With vectors of 512 bits it reads by gathers, or by loads and
// permutations where those take less time.
const KeyKernels& key_kernels(int vector_level, bool gathers = true);

}  // namespace dodgesim
