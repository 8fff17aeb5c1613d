// The normal distribution.
#pragma once

namespace dodgesim {

// Quantile of the standard normal for p in (0, 1) (Wichura 1988, algorithm AS 241, 1e-16).
double normal_quantile(double p);

}  // namespace dodgesim
