// The one value of gravity.
#pragma once

namespace dodgesim {

inline constexpr double kGravityMps2 = 9.81;  // along -z of W

}  // namespace dodgesim
