// The natural logarithm that decides on events. Our own because libm's differs between machines
// in the last bit, and because this one is inlined and has no branches. And its inverse.
#pragma once

#include <bit>
#include <cstdint>

namespace dodgesim {

// ln(x) for positive, finite, normal x; error below 3e-16 relative to max(1, |ln x|).
// x = 2^k m with m in [sqrt(1/2), sqrt(2)); ln m = 2 atanh(s) with s = (m - 1)/(m + 1).
inline double natural_log(double x) {
  constexpr std::uint64_t kSqrtHalf = 0x3fe6a09e667f3bcdu;
  constexpr std::uint64_t kExponentMask = 0xfff0000000000000u;
  constexpr std::uint64_t kSign = 0x8000000000000000u;
  constexpr double kTwo52 = 4503599627370496.0;            // its lowest bit counts ones
  constexpr double kLn2High = 6.93147180369123816490e-01;  // 33 bits: k * kLn2High is exact
  constexpr double kLn2Low = 1.90821492927058770002e-10;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t offset = bits - kSqrtHalf;
  // Of 64-bit integers AVX2 has no arithmetic shift and no conversion: k + 2048 is put into the
  // low bits of 2^52.
  const std::uint64_t k_2048 = (offset ^ kSign) >> 52;
  const double k =
      std::bit_cast<double>(std::bit_cast<std::uint64_t>(kTwo52) | k_2048) - (kTwo52 + 2048);
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

// The same in single precision; error below 2e-7 relative to max(1, |ln x|). Of the series two
// terms are left, fitted so that the greatest error is least (3.5e-8).
inline float natural_log(float x) {
  constexpr std::uint32_t kSqrtHalf = 0x3f3504f3u;
  constexpr std::uint32_t kExponentMask = 0xff800000u;
  constexpr float kLn2High = 0.693145751953125f;  // 16 bits: k * kLn2High is exact
  constexpr float kLn2Low = 1.42860677e-06f;
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t offset = bits - kSqrtHalf;
  const auto k = static_cast<float>(static_cast<std::int32_t>(offset) >> 23);
  const float m = std::bit_cast<float>(bits - (offset & kExponentMask));
  const float s = (m - 1) / (m + 1);
  const float z = s * s;
  const float p = 0.412874762f * z + 0.666534275f;
  return (k * kLn2High + 2 * s) + (s * z * p + k * kLn2Low);
}

// exp(x) for |x| < 700; relative error below 1e-11. x = k ln 2 + r with |r| <= ln(2)/2.
inline double natural_exp(double x) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  const double shifted = x * 1.4426950408889634 + kRound;
  const double r = x - (shifted - kRound) * 6.93147180559945309417e-01;
  // The series up to r^9, summed in pairs so that no term waits for all others.
  const double r2 = r * r, r4 = r2 * r2;
  const double low = (1.0 + r) + r2 * (1.0 / 2 + r * (1.0 / 6));
  const double middle = (1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720 + r * (1.0 / 5040));
  const double high = 1.0 / 40320 + r * (1.0 / 362880);
  const double p = low + r4 * (middle + r4 * high);
  const auto k = std::bit_cast<std::uint64_t>(shifted) << 52;  // its low bits are those of k
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(p) + k);
}

// exp(-x) for x >= 0: what is left of a transient after x time constants. The same as after 690 of
// them for all that are longer, so that it stays within natural_exp's range; nothing is left then.
[[gnu::always_inline]] inline double transient_left(double x) {
  constexpr double kMost = 690;
  return natural_exp(-(x < kMost ? x : kMost));
}

}  // namespace dodgesim
