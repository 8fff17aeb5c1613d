// How a pixel answers to light: logarithmically, or below a given luminance linearly.
#pragma once

#include <concepts>

#include "sim/base/branchless.h"
#include "sim/events/logarithm.h"

namespace dodgesim {

// L = ln(eps + I), and where I is less than `linear_below` the tangent there. Luminance is finite
// and not negative. In double or in single precision.
template <class Number>
class ResponseOf {
 public:
  ResponseOf(double log_epsilon, double linear_below)
      : epsilon_(static_cast<Number>(log_epsilon)),
        linear_below_(static_cast<Number>(linear_below)),
        slope_(static_cast<Number>(1 / (log_epsilon + linear_below))),
        knee_(static_cast<Number>(natural_log(log_epsilon + linear_below))) {}

  bool linear_somewhere() const { return linear_below_ > 0; }
  // at() where it is linear nowhere.
  [[gnu::always_inline]] Number logarithm(Number luminance) const {
    return natural_log(epsilon_ + luminance);
  }

  [[gnu::always_inline]] Number at(Number luminance) const {
    const Number log = logarithm(luminance);
    const Number line = knee_ + slope_ * (luminance - linear_below_);
    return luminance < linear_below_ ? line : log;
  }

  // The luminance that gives `l`; may be negative.
  [[gnu::always_inline]] double inverse(double l) const requires std::same_as<Number, double> {
    const double line = linear_below_ + (l - knee_) / slope_;
    const double exp = natural_exp(smaller(larger(l, -kMostLog), kMostLog)) - epsilon_;
    return (l < knee_) & (linear_below_ > 0) ? line : exp;
  }

 private:
  static constexpr double kMostLog = 690;

  Number epsilon_, linear_below_, slope_, knee_;
};

using Response = ResponseOf<double>;

}  // namespace dodgesim
