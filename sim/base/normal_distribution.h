// The standard normal distribution.
#pragma once

namespace dodgesim {

double normal_density(double z);

// Share of it below z.
double normal_cdf(double z);

// Quantile for p in (0, 1) (Wichura 1988, algorithm AS 241, 1e-16).
double normal_quantile(double p);

}  // namespace dodgesim
