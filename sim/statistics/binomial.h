// Binomial and hypergeometric probabilities, accurate in the tails and for millions of trials.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace dodgesim {

// A term of a sum of probabilities that is below this share of it is below its rounding.
inline constexpr double kNegligibleTerm = 1e-18;

// P(X = k) for X ~ Bin(n, p), natural logarithm. Saddle-point form of Loader 2000 ("Fast and
// accurate computation of binomial probabilities"), relative error of P about 1e-13 at any n.
// Requires n >= 0 and 0 <= p <= 1; -infinity where P is 0.
double log_binomial_pmf(std::int64_t k, std::int64_t n, double p);
double binomial_pmf(std::int64_t k, std::int64_t n, double p);

// P(X <= k) and P(X >= k).
double binomial_lower_tail(std::int64_t k, std::int64_t n, double p);
double binomial_upper_tail(std::int64_t k, std::int64_t n, double p);

// P(X = 0), ..., P(X = n).
std::vector<double> binomial_pmf_table(std::int64_t n, double p);

// P(X = k) when `drawn` are drawn without replacement from `marked` + `unmarked`, and X of them are
// marked. 0 outside of the support.
double hypergeometric_pmf(std::int64_t k, std::int64_t marked, std::int64_t unmarked,
                          std::int64_t drawn);

// Largest value of a p-value over the nuisance probability in [lo, hi]: the supremum that
// unconditional exact tests ask for. Searched on 300 points, denser towards both ends (where the
// p-value may vary within 1/n), then refined around the best of them.
double largest_p_value(double lo, double hi, const std::function<double(double)>& p_value);

}  // namespace dodgesim
