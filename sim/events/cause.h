// Why an event happened: ground truth, which no event camera gives and the pilot never sees.
#pragma once

#include <cstdint>

namespace dodgesim {

// The static scene (moved by ego-motion), an object in it, or noise.
using Cause = std::uint8_t;

inline constexpr Cause kCauseScene = 0;
inline constexpr Cause kCauseFirstObject = 1;  // object i is kCauseFirstObject + i
inline constexpr Cause kCauseLastObject = 252;
inline constexpr Cause kCauseLeak = 253;
inline constexpr Cause kCauseShotNoise = 254;
inline constexpr Cause kCauseHotPixel = 255;

}  // namespace dodgesim
