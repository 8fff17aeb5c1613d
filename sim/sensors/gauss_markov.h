// Gauss-Markov noise, discretised exactly: right for any sequence of time steps.
#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "sim/base/random.h"

namespace dodgesim {

// N independent standard normal numbers.
template <int N>
Eigen::Matrix<double, N, 1> normal_vector(RandomStream& random) {
  Eigen::Matrix<double, N, 1> values;
  for (int i = 0; i < N; ++i) values[i] = random.normal();
  return values;
}

// dx = -x / correlation_s dt + density dW in each of N components; a pure random walk when
// correlation_s = 0. Starts from N(0, initial_sigma^2).
template <int N>
class GaussMarkov {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  GaussMarkov(double density, double correlation_s, double initial_sigma, RandomStream random)
      : density_(density), correlation_s_(correlation_s), random_(random) {
    value_ = initial_sigma * normal_vector<N>(random_);
  }

  // The process whose standard deviation is always `sigma`, correlated as exp(-|dt|/correlation_s).
  static GaussMarkov stationary(double sigma, double correlation_s, RandomStream random) {
    return GaussMarkov(sigma * std::sqrt(2 / correlation_s), correlation_s, sigma, random);
  }

  // Advances by dt_s >= 0 seconds.
  const Vector& step(double dt_s) {
    if (dt_s <= 0) return value_;
    if (correlation_s_ > 0) {
      const double variance =
          -0.5 * density_ * density_ * correlation_s_ * std::expm1(-2 * dt_s / correlation_s_);
      value_ = std::exp(-dt_s / correlation_s_) * value_ +
               std::sqrt(variance) * normal_vector<N>(random_);
    } else {
      value_ += density_ * std::sqrt(dt_s) * normal_vector<N>(random_);
    }
    return value_;
  }

  const Vector& value() const { return value_; }

 private:
  double density_;
  double correlation_s_;
  RandomStream random_;
  Vector value_;
};

}  // namespace dodgesim
