// Minimum, maximum and a select without a branch, by value so that loops over them are vectorised.
// Minimum and maximum are the second argument if either is NaN.
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

// `a` if the mask is -1, `b` if it is 0: a select by bit mask. Written with ?:, compilers compute
// everything that depends on the result twice, divisions included.
[[gnu::always_inline]] inline float chosen(std::int32_t mask, float a, float b) {
  const auto y = std::bit_cast<std::int32_t>(b);
  return std::bit_cast<float>(y ^ ((std::bit_cast<std::int32_t>(a) ^ y) & mask));
}

}  // namespace dodgesim
