#include "dodge/presets.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "dodge/dodger.h"
#include "sim/camera/looking_forward.h"

namespace dodge {
namespace {

Config with_cameras(Config config) {
  config.cameras.resize(2);
  for (CameraModel& camera : config.cameras) {
    camera.X_BC.linear() = dodgesim::looking_forward();
  }
  config.cameras[0].X_BC.translation().z() = 0.15;
  return config;
}

TEST(Presets, FlyAsTheyAre) {
  for (const char* pilot : {"falanga2020", "dodgesim"}) {
    EXPECT_NO_THROW(Dodger(with_cameras(preset(pilot)))) << pilot;
  }
}

TEST(Presets, LeaveThePaperAsItIs) {
  const Config paper = preset("falanga2020");
  EXPECT_EQ(paper.position.max_range_m, 1.5);
  EXPECT_EQ(paper.window.window_us, 10000);
  EXPECT_EQ(paper.escape.law, "potential_field");
  EXPECT_EQ(paper.velocity_limit.calm_acceleration_mps2, 0);
  EXPECT_FALSE(paper.kalman.gravity);
  EXPECT_EQ(paper.kalman.lateral_size_share, 0);
  EXPECT_EQ(paper.association.gate_sigmas, 0);
  EXPECT_EQ(paper.association.tentative_timeout_us, 25000);
  EXPECT_EQ(paper.cluster.weight_position_1ppx, 0.2);
  EXPECT_EQ(paper.cluster.max_aspect, 4);
  EXPECT_EQ(paper.position.stereo.min_share_of_best, 0);
}

TEST(Presets, ThereAreNoOthers) { EXPECT_THROW(preset("oracle"), std::invalid_argument); }

}  // namespace
}  // namespace dodge
