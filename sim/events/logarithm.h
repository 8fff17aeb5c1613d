// The natural logarithm that decides on events. Our own because libm's differs between machines
// in the last bit, and because this one is inlined and has no branches.
#pragma once

#include <bit>
#include <cstdint>

namespace dodgesim {

// ln(x) for positive, finite, normal x; error below 3e-16 relative to max(1, |ln x|).
// x = 2^k m with m in [sqrt(1/2), sqrt(2)); ln m = 2 atanh(s) with s = (m - 1)/(m + 1).
inline double natural_log(double x) {
  constexpr std::uint64_t kSqrtHalf = 0x3fe6a09e667f3bcdu;
  constexpr std::uint64_t kExponentMask = 0xfff0000000000000u;
  constexpr double kLn2High = 6.93147180369123816490e-01;  // 33 bits: k * kLn2High is exact
  constexpr double kLn2Low = 1.90821492927058770002e-10;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t offset = bits - kSqrtHalf;
  const auto k = static_cast<double>(static_cast<std::int64_t>(offset) >> 52);
  const double m = std::bit_cast<double>(bits - (offset & kExponentMask));
  const double s = (m - 1) / (m + 1);
  const double z = s * s;  // at most 0.0295: ten terms of the series reach 2e-17
  double p = 2.0 / 19;
  p = p * z + 2.0 / 17;
  p = p * z + 2.0 / 15;
  p = p * z + 2.0 / 13;
  p = p * z + 2.0 / 11;
  p = p * z + 2.0 / 9;
  p = p * z + 2.0 / 7;
  p = p * z + 2.0 / 5;
  p = p * z + 2.0 / 3;
  return k * kLn2High + (2 * s + (s * z * p + k * kLn2Low));
}

}  // namespace dodgesim
