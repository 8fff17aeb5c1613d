// Minimum and maximum by value, so that loops over them are vectorised. What is not a number gives
// way to the second argument. And choices that are not followed to the end.
#pragma once

#include <bit>
#include <cstdint>

namespace dodgesim {

template <class Number>
[[gnu::always_inline]] inline Number smaller(Number a, Number b) {
  return a < b ? a : b;
}

template <class Number>
[[gnu::always_inline]] inline Number larger(Number a, Number b) {
  return a > b ? a : b;
}

// `a` where the mask is -1, `b` where it is 0. Written as a choice, compilers compute all that
// depends on it twice, divisions and all.
[[gnu::always_inline]] inline float chosen(std::int32_t mask, float a, float b) {
  const auto y = std::bit_cast<std::int32_t>(b);
  return std::bit_cast<float>(y ^ ((std::bit_cast<std::int32_t>(a) ^ y) & mask));
}

}  // namespace dodgesim
