// Why an event happened: ground truth, which no event camera gives and the pilot never sees.
#pragma once

#include <cstdint>

namespace dodgesim {

// The static scene (moved by ego-motion), an object in it, or noise. Where an object has been, a
// pixel of low bandwidth goes on making events of its light for a while. A leak's event is one to
// which the leak since the pixel's last event gave more than half of the threshold; a pixel starts
// as if it had leaked for a while already, so that without noise half of all first ON events are a
// leak's (of the sees1 an eighth).
using Cause = std::uint8_t;

inline constexpr Cause kCauseScene = 0;
inline constexpr Cause kCauseFirstObject = 1;  // object i is kCauseFirstObject + i
inline constexpr Cause kCauseLastObject = 252;
inline constexpr Cause kCauseLeak = 253;
inline constexpr Cause kCauseShotNoise = 254;
inline constexpr Cause kCauseHotPixel = 255;

inline constexpr bool of_object(Cause cause) {
  return cause >= kCauseFirstObject && cause <= kCauseLastObject;
}

}  // namespace dodgesim
