#include "dodge/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "tests/complaint.h"
#include "tests/dodge/synthetic_events.h"

namespace dodge {
namespace {

Config valid() {
  Config config;
  config.cameras = synthetic::vertical_pair();
  return config;
}

// The sentence of the exception; empty if there is none.
std::string complaint(const Config& config) {
  return dodgesim::testing::complaint<std::invalid_argument>([&] { validate(config); });
}

TEST(Config, DefaultsAreValid) { EXPECT_EQ(complaint(valid()), ""); }

TEST(Config, NamesTheParameterThatIsOutOfRange) {
  Config config = valid();
  config.window.window_us = 10;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("window.window_us is 10"));
  config = valid();
  config.position.stereo.disparity_sigma_px = -1;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("position.stereo.disparity_sigma_px"));
  config = valid();
  config.cluster.eps = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("cluster.eps"));
  config = valid();
  config.position.depth = "lidar";
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("must be one of mono, stereo"));
}

TEST(Config, RefusesKernelsWithoutACentreAndEmptyRanges) {
  Config config = valid();
  config.time_image.blur_px = 4;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("blur_px is 4 but must be odd"));
  config = valid();
  config.flow.window_px = 8;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("flow.window_px"));
  config = valid();
  config.range_sensor.min_range_m = 60;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("range_sensor.max_range_m"));
  config = valid();
  config.landing.touchdown_mps = 1;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("landing.descent_mps"));
  config = valid();
  config.velocity_limit = {.max_speed_mps = 3, .evading_threshold_mps = 4};
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("velocity_limit.evading_threshold_mps is 4"));
  config = valid();
  config.position.min_range_m = 2;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("min_range_m"));
  config = valid();
  config.position.min_size_m = 0.9;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("min_size_m"));
}

TEST(Config, RefusesAFieldWhoseForceIsInfinite) {
  Config config = valid();
  config.repulsive.gamma = 0.5;
  EXPECT_EQ(complaint(config), "");
  config.repulsive.field = "khosla";
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("repulsive.gamma is 0.5"));
}

TEST(Config, RefusesAnEscapeThatEndsAsSoonAsItStarts) {
  Config config = valid();
  config.escape.keep_probability = 2 * config.escape.min_probability;
  EXPECT_EQ(complaint(config),
            "The parameter escape.keep_probability is 0.6 but must not exceed "
            "escape.min_probability, which is 0.3.");
}

TEST(Config, StereoNeedsARectifiedVerticalPair) {
  Config config = valid();
  config.cameras.pop_back();
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("needs 2 camera(s)"));
  config = valid();
  std::swap(config.cameras[0], config.cameras[1]);
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("straight below"));
  config = valid();
  config.cameras[1].X_BC.translation().y() += 0.05;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("straight below"));
  config = valid();
  config.cameras[1].X_BC.rotate(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX()));
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("same orientation"));
  config = valid();
  config.cameras[1].fx += 1;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("same intrinsics"));
  config = valid();
  config.cameras[1].height = 200;
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("320 x 240 pixels and the second 320 x 200"));
  config = valid();
  config.cameras[1].X_BC.translation() =
      config.cameras[0].X_BC.translation() - Eigen::Vector3d(0, 0, 1e-6);
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("at least 0.001 m apart"));
}

// What a calibration must not be, by its complaint.
struct BadCalibration {
  const char* complaint;
  std::function<void(CameraModel&)> spoil;
};

TEST(Config, RefusesCalibrationsThatCannotBe) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const BadCalibration bad[] = {
      {"not finite", [&](CameraModel& c) { c.fx = infinite; }},
      {"not finite", [&](CameraModel& c) { c.cy = nan; }},
      {"not finite", [&](CameraModel& c) { c.k1 = nan; }},
      {"not finite", [&](CameraModel& c) { c.X_BC.translation().x() = nan; }},
      {"not finite", [&](CameraModel& c) { c.X_BC.linear()(1, 2) = nan; }},
      {"not finite", [&](CameraModel& c) { c.X_BC.translation().z() = -infinite; }},
      {"positive focal", [&](CameraModel& c) { c.fy = -190; }},
      {"million pixels", [&](CameraModel& c) { c.fx = 1e300; }},
      {"right angles", [&](CameraModel& c) { c.fx = 1e-300; }},
      {"right angles", [&](CameraModel& c) { c.cx = 1e9; }},
      {"no rotation", [&](CameraModel& c) { c.X_BC.linear() *= 2; }},
      {"no rotation", [&](CameraModel& c) { c.X_BC.linear() *= -1; }},
      {"no rotation", [&](CameraModel& c) { c.X_BC.linear().setZero(); }}};
  for (const BadCalibration& each : bad) {
    for (std::size_t i = 0; i < 2; ++i) {
      Config config = valid();
      each.spoil(config.cameras[i]);
      EXPECT_THAT(complaint(config),
                  ::testing::AllOf(::testing::HasSubstr(each.complaint),
                                   ::testing::HasSubstr("Camera " + std::to_string(i))));
    }
    Config both = valid();  // alike, as a rectified pair
    for (CameraModel& camera : both.cameras) each.spoil(camera);
    EXPECT_THAT(complaint(both), ::testing::HasSubstr(each.complaint));
  }
}

TEST(Config, RefusesARangeSensorThatIsNowhere) {
  Config config = valid();
  config.p_BR.z() = std::nan("");
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("p_BR is not finite"));
}

TEST(Config, ALensMustHaveALineOfSightForEveryPixel) {
  Config config = valid();
  for (CameraModel& camera : config.cameras) camera.k1 = 0.4;  // stretches ever more
  EXPECT_EQ(complaint(config), "");
  for (CameraModel& camera : config.cameras) camera.k1 = -0.25;  // folds before the corners
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("has no inverse at pixel (0, 0)"));
}

TEST(Config, AnEscapeNeedsObstaclesThatAreRemembered) {
  Config config = valid();
  config.repulsive.k_r0 = 0;
  EXPECT_EQ(complaint(config), "");
  config.escape.law = "closest_approach";
  EXPECT_EQ(complaint(config),
            "The parameter repulsive.k_r0 is 0 but must exceed repulsive.k_tau, which is 0.001.");
}

TEST(Config, MonoNeedsOneCamera) {
  Config config = valid();
  config.position.depth = "mono";
  config.cameras.pop_back();
  EXPECT_EQ(complaint(config), "");
  config.cameras.clear();
  EXPECT_THAT(complaint(config), ::testing::HasSubstr("needs 1 camera(s)"));
}

}  // namespace
}  // namespace dodge
