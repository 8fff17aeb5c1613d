#include "sim/config/resolve_throw.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/config/parse.h"

namespace dodgesim {
namespace {

constexpr const char* kRandom =
    "throw:\n"
    "  object: !choice [ball, box]\n"
    "  size_m: !uniform [0.1, 0.3]\n"
    "  speed_mps: !uniform [3, 8]\n"
    "  distance_m: !uniform [2, 5]\n"
    "  bearing_deg: !uniform [-40, 40]\n"
    "  aim_offset_m: !uniform [-0.1, 0.1]\n"
    "  spin_radps: !uniform [1, 5]\n"
    "  launch_height_m: !uniform [1, 2]\n"
    "  launch_s: !uniform [0.5, 1.5]\n";

Throw resolve_throw(const Scenario& scenario, int index) {
  return resolve_throws(scenario, index).front();
}

TEST(ResolveThrow, IsAPureFunctionOfSeedAndIndex) {
  const Scenario scenario = parse(kRandom);
  const Throw a = resolve_throw(scenario, 17);
  resolve_throw(scenario, 3);
  const Throw b = resolve_throw(scenario, 17);
  EXPECT_EQ(a.speed_mps, b.speed_mps);
  EXPECT_EQ(a.spin_radps, b.spin_radps);
  EXPECT_NE(a.speed_mps, resolve_throw(scenario, 18).speed_mps);
  Scenario other_seed = scenario;
  other_seed.seed = 2;
  EXPECT_NE(a.speed_mps, resolve_throw(other_seed, 17).speed_mps);
}

// Common random numbers: a campaign with other balls has the same throws otherwise.
TEST(ResolveThrow, ChangingOneKeyLeavesTheDrawsOfTheOthersAlone) {
  const Scenario before = parse(kRandom);
  Scenario after = before;
  after.throw_spec->size_m = Distribution::normal(0.2, 0.05, 0.01, 1);
  after.throw_spec->object = {{"ball"}};
  for (int i = 0; i < 20; ++i) {
    const Throw a = resolve_throw(before, i);
    const Throw b = resolve_throw(after, i);
    EXPECT_NE(a.object.size_m, b.object.size_m);
    EXPECT_EQ(a.speed_mps, b.speed_mps);
    EXPECT_EQ(a.distance_m, b.distance_m);
    EXPECT_EQ(a.bearing_deg, b.bearing_deg);
    EXPECT_EQ(a.aim_offset_m, b.aim_offset_m);
    EXPECT_EQ(a.spin_radps, b.spin_radps);
    EXPECT_EQ(a.launch_height_m, b.launch_height_m);
    EXPECT_EQ(a.launch_us, b.launch_us);
  }
}

TEST(ResolveThrow, KeysAndComponentsAreUncorrelated) {
  const Scenario scenario = parse(kRandom);
  constexpr int kThrows = 4000;
  std::vector<std::array<double, 7>> draws(kThrows);
  for (int i = 0; i < kThrows; ++i) {
    const Throw toss = resolve_throw(scenario, i);
    draws[static_cast<std::size_t>(i)] = {
        toss.object.size_m,    toss.speed_mps,        toss.distance_m,     toss.bearing_deg,
        toss.aim_offset_m.x(), toss.aim_offset_m.y(), toss.launch_height_m};
  }
  for (std::size_t a = 0; a < 7; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      double mean_a = 0, mean_b = 0, aa = 0, bb = 0, ab = 0;
      for (const auto& d : draws) mean_a += d[a] / kThrows, mean_b += d[b] / kThrows;
      for (const auto& d : draws) {
        aa += (d[a] - mean_a) * (d[a] - mean_a);
        bb += (d[b] - mean_b) * (d[b] - mean_b);
        ab += (d[a] - mean_a) * (d[b] - mean_b);
      }
      EXPECT_LT(std::abs(ab / std::sqrt(aa * bb)), 4 / std::sqrt(double(kThrows))) << a << " " << b;
    }
  }
}

TEST(ResolveThrow, ScalarSpinIsARateAboutARandomAxis) {
  const Scenario scenario = parse("throw: {spin_radps: 10}\n");
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  constexpr int kThrows = 4000;
  for (int i = 0; i < kThrows; ++i) {
    const Eigen::Vector3d spin = resolve_throw(scenario, i).spin_radps;
    EXPECT_NEAR(spin.norm(), 10, 1e-9);
    mean += spin / kThrows;
    covariance += spin * spin.transpose() / kThrows;
  }
  // Uniform on the sphere of radius r: mean 0, covariance r^2/3 I.
  EXPECT_LT(mean.norm(), 0.5);
  EXPECT_LT((covariance / (100.0 / 3) - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.08);
}

TEST(ResolveThrow, VectorSpinIsTakenAsItIs) {
  const Throw toss = resolve_throw(parse("throw: {spin_radps: [1, 2, 3]}\n"), 0);
  EXPECT_EQ(toss.spin_radps, Eigen::Vector3d(1, 2, 3));
}

TEST(ResolveThrow, TheLaunchFallsOnATick) {
  const Scenario scenario = parse(kRandom);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(resolve_throw(scenario, i).launch_us % kTickUs, 0);
}

}  // namespace
}  // namespace dodgesim
