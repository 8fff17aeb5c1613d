#include "sim/events/light_between.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodgesim {
namespace {

TEST(LightBetween, HasStepsOnlyForACameraWithNoise) {
  EXPECT_EQ(LightBetween(event_camera_preset("ideal")).steps(100000000), 1);
  EventCameraSpec leaking = event_camera_preset("ideal");
  leaking.leak_hz = 0.1;
  const LightBetween light(leaking);
  EXPECT_EQ(light.steps(1), 1);
  EXPECT_EQ(light.steps(50000), 1);
  EXPECT_EQ(light.steps(50001), 2);
  EXPECT_EQ(light.steps(100000000), 2000);
}

TEST(LightBetween, MovesTheLogarithmOfEveryPixelLinearly) {
  const EventCameraSpec spec = event_camera_preset("ideal");
  const std::vector<float> before = {0, 0.5F, 2, 0.3F}, after = {1, 0.1F, 2, 0};
  std::vector<float> between;
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    LightBetween(spec).at(share, before, after, between);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double l = (1 - share) * std::log(1e-3 + before[i]) + share * std::log(1e-3 + after[i]);
      EXPECT_NEAR(between[i], std::exp(l) - 1e-3, 1e-6) << share << " " << i;
    }
    EXPECT_EQ(between[2], 2);
  }
}

TEST(LightBetween, RunsStraightWhereThePixelAnswersLinearly) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.linear_below = 1;
  std::vector<float> between;
  LightBetween(spec).at(0.25, {0.2F}, {0.6F}, between);
  EXPECT_NEAR(between[0], 0.3, 1e-6);
}

}  // namespace
}  // namespace dodgesim
