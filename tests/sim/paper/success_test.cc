#include "sim/paper/success.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/paper/synthetic_passage.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

constexpr double kSpeedMps = 2;
constexpr RangeBin kNearBin{0, 0.5}, kMiddleBin{0.5, 1}, kFarBin{1, 1.5};

// At the height of the middle between the cameras.
TimeInView crossing(double depth_m, double size_m, const RangeBin& bin, Visibility visibility,
                    const std::vector<DetectionRow>& detections = {}) {
  const Trajectory trajectory = straight_flight({depth_m, 1, 0}, {0, -kSpeedMps, 0}, size_m);
  return time_in_view(Passage(trajectory, stereo_rig()), detections, bin, visibility);
}

// Half of the chord in which the distance to the upper camera is at most range_m.
double half_chord(double depth_m, double range_m) {
  return std::sqrt(std::max(0.0, range_m * range_m - depth_m * depth_m - 0.075 * 0.075));
}

TEST(TimeInView, LastsAsLongAsTheCentreCrossesTheView) {
  const double tangent = 160 / Intrinsics().f;
  for (const double depth_m : {0.3, 0.45, 0.6, 0.9}) {
    const double in_view = depth_m * tangent;
    const double near = std::min(in_view, half_chord(depth_m, 0.5));
    const double middle = std::min(in_view, half_chord(depth_m, 1)) - near;
    const double us_per_m = 2e6 / kSpeedMps;
    EXPECT_NEAR(
        static_cast<double>(crossing(depth_m, 0.1, kNearBin, Visibility::kCentre).visible_us),
        us_per_m * near, 2000)
        << depth_m;
    EXPECT_NEAR(
        static_cast<double>(crossing(depth_m, 0.1, kMiddleBin, Visibility::kCentre).visible_us),
        us_per_m * middle, 3000)
        << depth_m;
  }
}

TEST(TimeInView, OfTheWholeBallIsShorterByItsOutline) {
  const double tangent = 160 / Intrinsics().f, depth_m = 0.7, radius_m = 0.1;
  const RangeBin all{0, 10};
  const auto visible =
      static_cast<double>(crossing(depth_m, 2 * radius_m, all, Visibility::kWhole).visible_us);
  const double half_way_m = depth_m * tangent - radius_m * std::hypot(1, tangent);
  EXPECT_NEAR(visible, 2e6 / kSpeedMps * half_way_m, 2000);
  // At 0.3 m a ball of 30 cm does not fit between the cameras' views.
  EXPECT_EQ(crossing(0.3, 0.3, all, Visibility::kWhole).visible_us, 0);
}

TEST(TimeInView, CountsOnlyFromOneWindowOfEventsOn) {
  TimeInView time;
  time.visible_us = 9000;
  EXPECT_FALSE(time.counts());
  time.visible_us = 10000;
  EXPECT_TRUE(time.counts());
}

// The ball passes straight ahead, at 0.6 m, at 1.0 s.
TEST(TimeInView, TakesDetectionsOfTheBallInTheBin) {
  const Vector3d ball(0.6, 0, 0);
  const auto of = [&](const DetectionRow& row, const RangeBin& bin) {
    return crossing(0.6, 0.1, bin, Visibility::kCentre, {row}).detections;
  };
  EXPECT_EQ(of(detection(1000000, ball, ball, 0.6), kMiddleBin), 1);
  EXPECT_EQ(of(detection(1000000, ball, ball, 0.6), kFarBin), 0);
  // 20 cm too far is an error of the ball's distance; 20 cm aside is something else.
  EXPECT_EQ(of(detection(1000000, {0.8, 0, 0}, ball, 0.6), kMiddleBin), 1);
  EXPECT_EQ(of(detection(1000000, {0.6, 0.2, 0}, ball, 0.6), kMiddleBin), 0);
  // 0.3 s before it passes at 0.95 m a ball is at y = 0.6 m, 1.1 m away.
  const Vector3d before(0.95, 0.6, 0);
  const auto far = [&](const RangeBin& bin) {
    return crossing(0.95, 0.1, bin, Visibility::kCentre, {detection(700000, before, before, 0.95)})
        .detections;
  };
  EXPECT_EQ(far(kMiddleBin), 0);
  EXPECT_EQ(far(kFarBin), 1);
}

// The view ends 0.5 m to the left: a ball of 10 cm at 0.48 m has its centre in view alone.
TEST(TimeInView, ADetectionOfTheBallOutOfViewIsNone) {
  const auto at = [](double y_m, Visibility visibility) {
    const Vector3d ball(0.6, y_m, 0);
    const TimeUs t_us = 500000 + std::lround(1e6 * (1 - y_m) / kSpeedMps);
    return crossing(0.6, 0.1, kMiddleBin, visibility, {detection(t_us, ball, ball, 0.6)})
        .detections;
  };
  EXPECT_EQ(at(0.52, Visibility::kCentre), 0);
  EXPECT_EQ(at(0.48, Visibility::kCentre), 1);
  EXPECT_EQ(at(0.48, Visibility::kWhole), 0);
  EXPECT_EQ(at(0.42, Visibility::kWhole), 1);
}

TEST(TimeInView, IsCutIntoPiecesOfOneWindow) {
  const Vector3d ball(0.6, 0, 0);
  const TimeInView none = crossing(0.6, 0.1, kMiddleBin, Visibility::kCentre);
  EXPECT_EQ(none.pieces, none.visible_us / 10000);
  EXPECT_EQ(none.detected_pieces(), 0);
  EXPECT_EQ(none.missed_us[1] - none.missed_us[0], 10000);
  // Three detections in two pieces.
  const TimeInView some =
      crossing(0.6, 0.1, kMiddleBin, Visibility::kCentre,
               {detection(1000000, ball, ball, 0.6), detection(1000001, ball, ball, 0.6),
                detection(1015000, {0.6, -0.03, 0}, ball, 0.6)});
  EXPECT_EQ(some.detections, 3);
  EXPECT_EQ(some.detected_pieces(), 2);
  EXPECT_EQ(some.missed_us.size(), none.missed_us.size() - 2);
}

}  // namespace
}  // namespace dodgesim
