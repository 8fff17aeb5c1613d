// Deterministic random numbers for tests of the flight core, without the simulator's library:
// SplitMix64, uniform doubles and Box-Muller.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace dodge {

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
  }

  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform(0x1p-53, 1)));
    return radius * std::cos(uniform(0, 2 * std::numbers::pi));
  }

  Eigen::Vector3d uniform_vector(double low, double high) {
    const double x = uniform(low, high), y = uniform(low, high), z = uniform(low, high);
    return {x, y, z};
  }

  Eigen::Vector3d normal_vector() {
    const double x = normal(), y = normal(), z = normal();
    return {x, y, z};
  }

  Eigen::Matrix3d rotation() {
    const double w = normal();
    const Eigen::Vector3d v = normal_vector();
    return Eigen::Quaterniond(w, v.x(), v.y(), v.z()).normalized().toRotationMatrix();
  }

 private:
  std::uint64_t state_;
};

}  // namespace dodge
