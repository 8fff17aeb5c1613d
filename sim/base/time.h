// Time is integer microseconds (design invariant 2). Rates are divisors of the physics tick.
#pragma once

#include <cstdint>

namespace dodgesim {

using TimeUs = std::int64_t;

// Physics, rotors and the flight controller's rate loop advance by this step (4 kHz).
inline constexpr TimeUs kTickUs = 250;

inline constexpr double seconds(TimeUs t_us) { return 1e-6 * static_cast<double>(t_us); }

}  // namespace dodgesim
