// How a pixel answers to light: logarithmically, or below a given luminance linearly.
#pragma once

#include "sim/base/branchless.h"
#include "sim/events/logarithm.h"

namespace dodgesim {

// L = ln(eps + I), and where I is less than `linear_below` the tangent there. Luminance is finite
// and not negative.
class Response {
 public:
  Response(double log_epsilon, double linear_below)
      : epsilon_(log_epsilon),
        linear_below_(linear_below),
        slope_(1 / (log_epsilon + linear_below)),
        knee_(natural_log(log_epsilon + linear_below)) {}

  [[gnu::always_inline]] double at(double luminance) const {
    const double log = natural_log(epsilon_ + luminance);
    const double line = knee_ + slope_ * (luminance - linear_below_);
    return luminance < linear_below_ ? line : log;
  }

  // The luminance that gives `l`; may be negative.
  [[gnu::always_inline]] double inverse(double l) const {
    const double line = linear_below_ + (l - knee_) / slope_;
    const double exp = natural_exp(smaller(larger(l, -kMostLog), kMostLog)) - epsilon_;
    return (l < knee_) & (linear_below_ > 0) ? line : exp;
  }

  double epsilon() const { return epsilon_; }
  double linear_below() const { return linear_below_; }
  double slope() const { return slope_; }
  double knee() const { return knee_; }

 private:
  static constexpr double kMostLog = 690;

  double epsilon_, linear_below_, slope_, knee_;
};

}  // namespace dodgesim
