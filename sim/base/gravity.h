// Gravity. The flight core has a constant of its own, because it builds alone.
#pragma once

namespace dodgesim {

inline constexpr double kGravityMps2 = 9.81;  // along -z of W

}  // namespace dodgesim
