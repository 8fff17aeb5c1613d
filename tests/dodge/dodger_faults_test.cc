// Sensors that are broken, or whose clocks are off.
#include <gtest/gtest.h>

#include <functional>

#include "dodge/dodger.h"
#include "tests/dodge/synthetic_flight.h"

namespace dodge {
namespace {

using synthetic::Flight, synthetic::kCycleUs, synthetic::still;

Config two_cameras() {
  Config config;
  config.cameras = synthetic::vertical_pair();
  return config;
}

// The commands of a throw at which `spoil` adds to what the flight hands over, cycle by cycle.
std::vector<VelocityCommand> commands(Dodger& dodger,
                                      const std::function<void(Dodger&, TimeUs)>& spoil) {
  Flight flight(still, {synthetic::thrown_ball({3, 0, 0}, {0, 0, 0.1}, 5, 0.3, 1)}, {}, 5);
  std::vector<VelocityCommand> commands;
  for (TimeUs t = kCycleUs; t <= 500000; t += kCycleUs) {
    flight.advance(t);
    spoil(dodger, t);
    commands.push_back(flight.feed(dodger));
  }
  return commands;
}

TEST(DodgerFaults, TimeStampsFarOffCostTheirOwnEventsOnly) {
  Dodger undisturbed(two_cameras()), disturbed(two_cameras());
  const auto nothing = [](Dodger&, TimeUs) {};
  const auto wrong = [](Dodger& dodger, TimeUs t) {
    if (t != 20 * kCycleUs) return;
    const std::vector<Event> events = {{.t_us = t + 10000000, .x = 9, .y = 9, .polarity = 1},
                                       {.t_us = t - 8 * kCycleUs, .x = 9, .y = 9, .polarity = 1}};
    for (int camera = 0; camera < 2; ++camera) dodger.add_events(camera, events);
  };
  const std::vector<VelocityCommand> right = commands(undisturbed, nothing);
  const std::vector<VelocityCommand> same = commands(disturbed, wrong);
  bool evading = false;
  for (std::size_t i = 0; i < right.size(); ++i) {
    ASSERT_EQ(same[i].v_W, right[i].v_W) << i;
    ASSERT_EQ(same[i].t_us, right[i].t_us) << i;
    evading |= right[i].evading;
  }
  EXPECT_TRUE(evading);
  for (int camera = 0; camera < 2; ++camera) {
    EXPECT_EQ(undisturbed.dropped_events(camera), 0);
    EXPECT_EQ(disturbed.dropped_events(camera), 2);
  }
  EXPECT_EQ(disturbed.dropped_events(7), 0);
}

TEST(DodgerFaults, ABrokenGyroscopeIsSurvived) {
  Dodger dodger(two_cameras());
  int cycles = 0;
  const auto broken = [&cycles](Dodger& handed, TimeUs t) {
    const double sign = ++cycles % 2 == 0 ? 1 : -1;
    handed.add_imu({t, sign * Eigen::Vector3d(1.7e308, 1.7e308, -1.7e308), {}});
  };
  for (const VelocityCommand& command : commands(dodger, broken)) {
    ASSERT_TRUE(command.v_W.allFinite());
  }
}

// The vehicle turns, then rests, and the ball comes; the last rate of the IMU is that of the turn.
TEST(DodgerFaults, AnImuThatFallsSilentInATurnIsReplacedByTheStateEstimate) {
  const auto turns_then_rests = [](double t_s) {
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
    X_WB.rotate(Eigen::AngleAxisd(2 * std::min(t_s - 0.15, 0.0), Eigen::Vector3d::UnitZ()));
    return X_WB;
  };
  Flight flight(turns_then_rests, {synthetic::thrown_ball({3, 0, 0}, {0, 0, 0.1}, 5, 0.3, 1)}, {},
                5);
  flight.end_imu(100000);
  Dodger dodger(two_cameras());
  int detections = 0;
  bool evading = false;
  for (TimeUs t = kCycleUs; t <= 500000; t += kCycleUs) {
    evading |= flight.cycle(dodger, t).evading;
    detections += static_cast<int>(dodger.detections().size());
  }
  EXPECT_EQ(dodger.newest_imu_us(), 100000);
  EXPECT_GT(detections, 10);
  EXPECT_TRUE(evading);
}

// Mean depth error [m] of a ball that falls past the cameras at 6 m/s.
double depth_error_m(TimeUs lower_camera_late_us, const Config& config) {
  const synthetic::Disk ball = {[](double t_s) { return Eigen::Vector3d(1.3, 0, 0.5 - 6 * t_s); },
                                0.1, 1};
  Flight flight(still, {ball}, {}, 5);
  flight.delay_lower_camera(lower_camera_late_us);
  Dodger dodger(config);
  double sum_m = 0;
  int seen = 0;
  for (TimeUs t = kCycleUs; t <= 180000; t += kCycleUs) {
    flight.cycle(dodger, t);
    for (const Detection& detection : dodger.detections()) {
      sum_m += (detection.centre_W - ball.p_W(seconds(detection.t_us))).x();
      ++seen;
    }
  }
  EXPECT_GT(seen, 15);
  return sum_m / seen;
}

TEST(DodgerFaults, ACameraWhosePacketsComeLaterDoesNotErrInDepth) {
  Config config = two_cameras();
  const double in_time_m = depth_error_m(0, config);
  for (const TimeUs late_us : {500, 1000, 2000}) {
    EXPECT_NEAR(depth_error_m(late_us, config), in_time_m, 0.01) << late_us;
  }
  config.window.camera_lag_us = 0;  // does not wait for it
  EXPECT_NEAR(depth_error_m(1000, config), in_time_m - 0.04, 0.01);
}

TEST(DodgerFaults, ASilentCameraHoldsUpTheOtherForAMomentOnly) {
  Dodger dodger(two_cameras());
  const Config config = two_cameras();
  for (TimeUs t = 0; t < 100000; t += 100) {
    dodger.add_events(0, std::vector<Event>{{.t_us = t, .polarity = 1}});
    if (t < 50000) dodger.add_events(1, std::vector<Event>{{.t_us = t, .polarity = 1}});
  }
  EXPECT_EQ(dodger.update(100000).t_us, 99900 - config.window.camera_lag_us);
}

// As when a log is played once more to the same pilot: the second time it sees what it saw first.
TEST(DodgerFaults, AClockThatIsSetBackCostsNothingOfWhatComesAfter) {
  Dodger dodger(two_cameras());
  const auto nothing = [](Dodger&, TimeUs) {};
  const std::vector<VelocityCommand> first = commands(dodger, nothing);
  const std::vector<VelocityCommand> again = commands(dodger, nothing);
  int evading = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(again[i].evading, first[i].evading) << i;
    evading += again[i].evading ? 1 : 0;
  }
  EXPECT_GT(evading, 3);
}

TEST(DodgerFaults, EventsALittleAheadWaitForTheirTime) {
  Dodger dodger(two_cameras());
  dodger.set_capture(true);
  const std::vector<Event> ahead = {{.t_us = 100000 + Dodger::kMostAheadUs, .polarity = 1}};
  for (int camera = 0; camera < 2; ++camera) dodger.add_events(camera, ahead);
  dodger.update(100000);
  EXPECT_TRUE(dodger.stage_images(0).window.empty());
  dodger.update(100000 + Dodger::kMostAheadUs);
  EXPECT_EQ(dodger.stage_images(0).window.size(), 1U);
  EXPECT_EQ(dodger.dropped_events(0), 0);
}

TEST(DodgerFaults, TellsHowOldItsDataAre) {
  Dodger dodger(two_cameras());
  dodger.update(5000);
  EXPECT_FALSE(dodger.newest_event_us(0).has_value());
  EXPECT_FALSE(dodger.newest_state_us().has_value());
  EXPECT_FALSE(dodger.newest_imu_us().has_value());
  dodger.add_imu({.t_us = 7000});
  dodger.add_events(0, std::vector<Event>{{.t_us = 9000}});
  dodger.add_state({.t_us = 8000});
  dodger.update(10000);
  dodger.update(1000000);  // blind since
  EXPECT_EQ(dodger.newest_event_us(0), 9000);
  EXPECT_FALSE(dodger.newest_event_us(1).has_value());
  EXPECT_EQ(dodger.newest_state_us(), 8000);
  EXPECT_EQ(dodger.newest_imu_us(), 7000);
  EXPECT_FALSE(dodger.newest_event_us(2).has_value());
}

}  // namespace
}  // namespace dodge
