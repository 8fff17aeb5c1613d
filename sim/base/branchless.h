// Minimum and maximum by value, so that loops over them are vectorised. What is not a number gives
// way to the second argument.
#pragma once

namespace dodgesim {

template <class Number>
[[gnu::always_inline]] inline Number smaller(Number a, Number b) {
  return a < b ? a : b;
}

template <class Number>
[[gnu::always_inline]] inline Number larger(Number a, Number b) {
  return a > b ? a : b;
}

}  // namespace dodgesim
