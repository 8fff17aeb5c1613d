// The quick test of pixels without a bandwidth or a leak: a luminance strictly between two bounds
// makes no event.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/vector_level.h"

namespace dodgesim {

// The bounds of all pixels, packed into 16 bits each so that a pass over them is short. Packing
// makes them slightly too narrow, never too wide.
class LuminanceBounds {
 public:
  LuminanceBounds(std::size_t pixels, double log_epsilon);

  // Bounds on the luminance I; low >= high: none holds. They are packed as eps + I.
  void set(std::size_t pixel, double low_luminance, double high_luminance);

  // may_fire[i] = 1 where luminance[i], that of the pixel first + i, is not between its bounds or
  // is negative or no number. The same at every vector level.
  void scan(std::size_t first, std::size_t size, const float* luminance, unsigned char* may_fire,
            int level = vector_level()) const;

 private:
  float epsilon_;
  std::vector<std::uint16_t> low_, high_;
};

}  // namespace dodgesim
