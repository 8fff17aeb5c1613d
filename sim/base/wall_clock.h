// The time that the computer takes. Nothing simulated depends on it.
#pragma once

#include <chrono>

namespace dodgesim {

using WallClock = std::chrono::steady_clock;

inline double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

}  // namespace dodgesim
