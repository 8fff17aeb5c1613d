// What the pilot dodgesim sees of balls over the open field.
#include <gtest/gtest.h>

#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

constexpr double kBallM = 0.2;
constexpr int kThrows = 24;

struct Sight {
  int whole = 0;      // detections of about the ball's own size
  int too_large = 0;  // with a part of the background
};

// Of balls of 8 m/s that nobody evades.
Sight sight_of(const std::string& cluster) {
  const Scenario s = scenario(
      "room: field\n"
      "pilot: dodgesim\n"
      "seed: 77\n"
      "repeats: 24\n"
      "mission: {start_m: [0, 0, 2]}\n"
      "throw: {size_m: 0.2, distance_m: !uniform [3, 4], speed_mps: 8,\n"
      "        bearing_deg: !uniform [-25, 25], launch_height_m: !uniform [1.2, 1.8],\n"
      "        launch_s: 0.1}\n"
      "dodger: {escape: {min_speed_mps: 100}, cluster: " +
      cluster + "}\n");
  Sight sight;
  for (int i = 0; i < kThrows; ++i) {
    for (const DetectionRow& row : fly(s, plan_throw(s, i)).rows) {
      if (row.object) ++(row.size_m < 1.5 * kBallM ? sight.whole : sight.too_large);
    }
  }
  return sight;
}

TEST(OwnPilot, KeepsABallApartFromItsBackground) {
  const Sight own = sight_of("{}"), paper = sight_of("{weight_position: 0.2}");
  EXPECT_GT(own.whole, 30 * kThrows);
  EXPECT_GT(own.whole, 1.1 * paper.whole);
  EXPECT_LT(own.too_large, paper.too_large);
}

}  // namespace
}  // namespace dodgesim
