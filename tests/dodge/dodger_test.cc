#include "dodge/dodger.h"

#include <gtest/gtest.h>

#include <functional>

#include "dodge/presets.h"
#include "tests/dodge/synthetic_flight.h"

namespace dodge {
namespace {

using synthetic::Flight, synthetic::kCycleUs, synthetic::still, synthetic::turning;

Config stereo() {
  Config config;
  config.cameras = synthetic::vertical_pair();
  return config;
}

synthetic::Disk crossing_ball(double diameter_m, double depth_m) {
  // From right to left at 4 m/s past the cameras' axis.
  return synthetic::thrown_ball({depth_m + 0.1, -0.5, 0}, {depth_m + 0.1, 0.5, 0}, 4, diameter_m,
                                1);
}

TEST(Dodger, StillCameraWithDefaultNoiseSeesNothing) {
  Flight flight(still, {}, {.noise_hz = 0.44, .hot_fraction = 0.0007, .hot_hz = 120}, 5);
  Dodger dodger(stereo());
  for (TimeUs t = kCycleUs; t < 12000000; t += kCycleUs) {
    const VelocityCommand command = flight.cycle(dodger, t);
    ASSERT_TRUE(dodger.clusters(0).empty() || dodger.clusters(1).empty()) << t;
    ASSERT_TRUE(dodger.detections().empty()) << t;
    ASSERT_FALSE(command.evading);
  }
}

TEST(Dodger, StaticSceneSeenByATurningCameraIsNoObstacle) {
  Flight flight(turning, synthetic::far_background(60, 8), {}, 5);
  Dodger dodger(stereo());
  int clusters = 0, cycles = 0;
  for (TimeUs t = kCycleUs; t < 600000; t += kCycleUs, ++cycles) {
    flight.cycle(dodger, t);
    clusters += static_cast<int>(dodger.clusters(0).size());
    for (const Obstacle& obstacle : dodger.obstacles()) ASSERT_LT(obstacle.detections, 3) << t;
  }
  EXPECT_LT(clusters, 0.1 * cycles);
}

TEST(Dodger, WithoutCompensationTheSameSceneIsFullOfObstacles) {
  Flight flight(turning, synthetic::far_background(60, 8), {}, 5);
  Config config = stereo();
  config.ego_motion.enabled = false;
  config.time_image.threshold_a_s = 0;
  Dodger dodger(config);
  int clusters = 0, cycles = 0;
  for (TimeUs t = kCycleUs; t < 500000; t += kCycleUs, ++cycles) {
    flight.cycle(dodger, t);
    clusters += static_cast<int>(dodger.clusters(0).size());
  }
  EXPECT_GT(clusters, cycles);
}

// The detections of a ball that crosses the view, against its true position.
struct Score {
  int seen = 0, cycles = 0;
  double worst_m = 0, mean_m = 0;
};

Score watch(const Config& config, const synthetic::Motion& motion, const synthetic::Disk& ball,
            int spots) {
  std::vector<synthetic::Disk> disks = synthetic::far_background(spots, 8);
  disks.push_back(ball);
  Flight flight(motion, disks, {}, 5);
  Dodger dodger(config);
  Score score;
  for (TimeUs t = kCycleUs; t <= 245000; t += kCycleUs) {
    flight.cycle(dodger, t);
    if (t < 20000) continue;
    ++score.cycles;
    if (dodger.detections().empty()) continue;
    ++score.seen;
    double nearest = 1e9;
    for (const Detection& d : dodger.detections()) {
      const Eigen::Vector3d truth = ball.p_W(1e-6 * static_cast<double>(d.t_us));
      nearest = std::min(nearest, (d.centre_W - truth).norm());
    }
    score.worst_m = std::max(score.worst_m, nearest);
    score.mean_m += nearest;
  }
  score.mean_m /= std::max(1, score.seen);
  return score;
}

// Mean error [m] over still and turning backgrounds and three sizes; every ball is seen.
double mean_error(const std::string& disparity) {
  Config config = stereo();
  config.position.stereo.disparity = disparity;
  config.time_image.threshold_b = 0.05;  // a higher one is blind to thin edges at 2 rad/s
  double sum = 0;
  for (const auto& motion : {synthetic::Motion(still), synthetic::Motion(turning)}) {
    for (const double diameter_m : {0.1, 0.2, 0.3}) {
      const Score score = watch(config, motion, crossing_ball(diameter_m, 1.2), 15);
      EXPECT_GT(score.seen, 0.9 * score.cycles) << disparity << " " << diameter_m;
      sum += score.mean_m;
    }
  }
  return sum / 6;
}

TEST(Dodger, StereoFindsABallOverAStillAndATurningBackground) {
  EXPECT_LT(mean_error("centres"), 0.13);  // Table 1 of the paper: 0.13 m at 1.0 to 1.5 m
  EXPECT_LT(mean_error("correlation"), 0.02);
}

TEST(Dodger, FindsABallInTheSamePlaceWhicheverInstantIsTheReference) {
  // To and fro at up to 4 rad/s: in a window of 10 ms by 4 cm at the ball.
  const auto shaking = [](double t_s) {
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
    X_WB.linear() = Eigen::AngleAxisd(0.2 * std::sin(20 * t_s), Eigen::Vector3d::UnitZ()).matrix();
    return X_WB;
  };
  Config config = stereo();
  const Score at_end = watch(config, shaking, crossing_ball(0.2, 1.2), 0);
  config.ego_motion.reference = "start";
  const Score at_start = watch(config, shaking, crossing_ball(0.2, 1.2), 0);
  EXPECT_GT(at_end.seen, 10);
  EXPECT_LT(at_end.mean_m, 0.04);
  EXPECT_NEAR(at_start.seen, at_end.seen, 2);
  EXPECT_NEAR(at_start.mean_m, at_end.mean_m, 0.003);
}

TEST(Dodger, MonoFindsABallOfKnownSize) {
  Config config = stereo();
  config.cameras.pop_back();
  config.position.depth = "mono";
  config.position.known_size_m = 0.2;
  const Score score = watch(config, still, crossing_ball(0.2, 1.0), 30);
  EXPECT_GT(score.seen, 0.9 * score.cycles);
  EXPECT_LT(score.mean_m, 0.15);
}

TEST(Dodger, RangeCapDropsWhatIsBeyond) {
  EXPECT_EQ(watch(stereo(), still, crossing_ball(0.2, 2.2), 0).seen, 0);
  Config far = stereo();
  far.position.max_range_m = 3;
  const Score score = watch(far, still, crossing_ball(0.2, 2.2), 0);
  EXPECT_GT(score.seen, 0.8 * score.cycles);
}

// In what share of the cycles a bar of 25 x 3 cm is seen that lies across the view, comes and
// rises.
double share_seen_of_bar(double max_aspect) {
  const synthetic::Disk middle = synthetic::thrown_ball({3, 0, -0.6}, {0.1, 0, 0.3}, 6, 0.03, 1);
  std::vector<synthetic::Disk> bar;
  for (int i = -5; i <= 5; ++i) {
    synthetic::Disk part = middle;
    part.p_W = [middle, i](double t_s) -> Eigen::Vector3d {
      return middle.p_W(t_s) + 0.022 * i * Eigen::Vector3d::UnitY();
    };
    bar.push_back(part);
  }
  Config config = preset("dodgesim");
  config.cluster.max_aspect = max_aspect;
  config.cameras = synthetic::vertical_pair();
  Flight flight(still, bar, {}, 5);
  Dodger dodger(config);
  int seen = 0, cycles = 0;
  for (TimeUs t = kCycleUs; t <= 300000; t += kCycleUs, ++cycles) {
    flight.cycle(dodger, t);
    if (!dodger.detections().empty()) ++seen;
  }
  return static_cast<double>(seen) / cycles;
}

TEST(Dodger, SeesThinObjectsIfItTakesLongClusters) {
  EXPECT_GT(share_seen_of_bar(1000), 0.8);
  EXPECT_LT(share_seen_of_bar(4), 0.1);  // what moves of it is a line
}

TEST(Dodger, EvadesABallThatComes) {
  const synthetic::Disk ball = synthetic::thrown_ball({3.5, 0.2, -0.2}, {0.1, 0, 0}, 6, 0.2, 1);
  Flight flight(still, {ball}, {}, 5);
  Dodger dodger(stereo());
  dodger.set_goal({});
  bool evading = false;
  for (TimeUs t = kCycleUs; t <= 550000; t += kCycleUs) {
    const VelocityCommand command = flight.cycle(dodger, t);
    evading = evading || command.evading;
    if (t < 250000) {
      EXPECT_FALSE(command.evading);  // 2 m away at least
    }
  }
  EXPECT_TRUE(evading);
}

TEST(Dodger, PacketsDoNotMatter) {
  const synthetic::Disk ball = crossing_ball(0.2, 1.2);
  const std::vector<CameraModel> cameras = synthetic::vertical_pair();
  Dodger one(stereo()), many(stereo());
  std::vector<synthetic::EventGenerator> generators;
  for (std::size_t i = 0; i < 2; ++i) {
    generators.emplace_back(cameras[i], still, std::vector{ball}, synthetic::Sensor{}, 5, i);
  }
  int compared = 0;
  for (TimeUs t = kCycleUs; t <= 200000; t += kCycleUs) {
    for (int i = 0; i < 2; ++i) {
      std::vector<Event> events;
      generators[static_cast<std::size_t>(i)].advance(t, events);
      one.add_events(i, events);
      for (const Event& event : events) many.add_events(i, {&event, 1});
      many.add_events(i, {});
    }
    for (Dodger* dodger : {&one, &many}) {
      dodger->add_state({.t_us = t});
      dodger->update(t);
    }
    ASSERT_EQ(one.detections().size(), many.detections().size());
    for (std::size_t k = 0; k < one.detections().size(); ++k, ++compared) {
      ASSERT_EQ(one.detections()[k].centre_W, many.detections()[k].centre_W);
    }
  }
  EXPECT_GT(compared, 20);
}

// A camera whose packets are farther apart than the time after which an obstacle is dropped that
// was not found again: between them nobody looks.
TEST(Dodger, SlowPacketsLoseNoObstacle) {
  Flight flight(still, {crossing_ball(0.2, 1.2)}, {}, 5);
  Config config = stereo();
  config.window.event_timeout_us = 100000;
  Dodger dodger(config);
  int most = 0;
  for (TimeUs t = 30000; t <= 210000; t += 30000) {
    flight.cycle(dodger, t);
    for (TimeUs between = t + kCycleUs; between < t + 30000; between += kCycleUs) {
      dodger.add_state(flight.state(t));
      dodger.update(between);
      ASSERT_TRUE(dodger.detections().empty());
    }
    for (const Obstacle& obstacle : dodger.obstacles()) {
      most = std::max(most, obstacle.detections);
    }
  }
  EXPECT_GE(most, 5);
}

TEST(Dodger, SilenceGivesNoDetectionTwice) {
  Flight flight(still, {crossing_ball(0.2, 1.2)}, {.noise_hz = 0}, 5);
  Dodger dodger(stereo());
  TimeUs t = kCycleUs;
  for (; t <= 100000; t += kCycleUs) flight.cycle(dodger, t);
  ASSERT_FALSE(dodger.detections().empty());
  const TimeUs last_us = dodger.detections()[0].t_us;
  EXPECT_LE(last_us, t);
  dodger.update(t);  // same events, a little later
  EXPECT_TRUE(dodger.detections().empty());
  dodger.update(t + 30000);  // the window has moved beyond all events
  EXPECT_TRUE(dodger.detections().empty());
  EXPECT_TRUE(dodger.clusters(0).empty());
}

TEST(Dodger, NothingReceivedIsAZeroCommand) {
  Dodger dodger(stereo());
  const VelocityCommand command = dodger.update(1000000);
  EXPECT_EQ(command.v_W, Eigen::Vector3d::Zero());
  EXPECT_FALSE(command.evading);
  EXPECT_TRUE(dodger.detections().empty());
  EXPECT_TRUE(dodger.obstacles().empty());
}

TEST(Dodger, EventsOfUnknownCamerasAndPixelsAreIgnored) {
  Dodger dodger(stereo());
  const std::vector<Event> events = {{.t_us = 1, .x = 65000, .y = 65000, .polarity = 1}};
  dodger.add_events(0, events);
  dodger.add_events(7, events);
  dodger.add_events(-1, events);
  dodger.add_state({.t_us = 1});
  dodger.set_capture(true);
  dodger.update(5000);
  EXPECT_TRUE(dodger.clusters(7).empty());
  for (int camera = 0; camera < 2; ++camera) {
    EXPECT_EQ(cv::countNonZero(dodger.stage_images(camera).count), 0);
  }
}

TEST(Dodger, CapturesThePanelsOfFigure4OnRequest) {
  Flight flight(still, {crossing_ball(0.3, 1.0)}, {}, 5);
  Dodger dodger(stereo());
  for (TimeUs t = kCycleUs; t <= 100000; t += kCycleUs) flight.cycle(dodger, t);
  EXPECT_TRUE(dodger.stage_images(0).events.empty());
  dodger.set_capture(true);
  flight.cycle(dodger, 105000);
  for (int camera = 0; camera < 2; ++camera) {
    const StageImages& images = dodger.stage_images(camera);
    ASSERT_EQ(images.events.size(), cv::Size(320, 240));
    EXPECT_GT(cv::countNonZero(images.events == 1), 20);
    EXPECT_GT(cv::countNonZero(images.events == 2), 20);
    EXPECT_EQ(cv::countNonZero(images.events), cv::countNonZero(images.count));
    EXPECT_GT(cv::countNonZero(images.rho > 0.1), 20);
    EXPECT_GT(cv::countNonZero(images.threshold_mask), 20);
    EXPECT_GT(cv::countNonZero(images.obstacle_mask), 20);
  }
  const StageTimes& times = dodger.stage_times();
  for (const double stage_us : {times.ego_motion_us, times.threshold_us, times.morphology_us,
                                times.clustering_us, times.rest_us}) {
    EXPECT_GT(stage_us, 0);
  }
}

// A vehicle truly 2 m above the ground, its estimate `error_m(t)` more, for three seconds; then the
// last command. It is on its way to a goal above it.
VelocityCommand with_height_error(Dodger& dodger, const std::function<double(double)>& error_m) {
  dodger.set_goal({.p_WG = {0, 0, 3}});
  VelocityCommand command;
  for (TimeUs t = kCycleUs; t < 3000000; t += kCycleUs) {
    StateEstimate state{.t_us = t};
    state.p_WB.z() = 2 + error_m(1e-6 * static_cast<double>(t));
    dodger.add_state(state);
    dodger.add_range({t, 2});
    command = dodger.update(t);
  }
  return command;
}

TEST(Dodger, LandsWhenTheRangeSensorDisagreesWithTheEstimatedHeight) {
  const double threshold_m = HeightMonitorConfig().threshold_m;
  const auto jump = [](double by_m) { return [=](double t_s) { return t_s < 1 ? 0.0 : by_m; }; };
  Dodger dodger(stereo()), near_miss(stereo());
  const VelocityCommand command = with_height_error(dodger, jump(-threshold_m - 1e-9));
  EXPECT_TRUE(command.landing);
  EXPECT_TRUE(command.v_W.isApprox(Eigen::Vector3d(0, 0, -LandingConfig().descent_mps), 1e-9));
  EXPECT_FALSE(with_height_error(near_miss, jump(-threshold_m + 1e-9)).landing);

  Config config = stereo();
  config.height_monitor.enabled = false;
  Dodger unmonitored(config);
  const VelocityCommand flies_on = with_height_error(unmonitored, jump(-0.5));
  EXPECT_FALSE(flies_on.landing);
  EXPECT_GT(flies_on.v_W.z(), 0);
}

TEST(Dodger, FliesOnWhenOnlyTheStartWasAtAnotherHeight) {
  Dodger dodger(stereo());
  const VelocityCommand command = with_height_error(dodger, [](double) { return -1.5; });
  EXPECT_FALSE(command.landing);
  EXPECT_GT(command.v_W.z(), 0);
}

TEST(Dodger, RangeReadingsBeforeTheFirstStateEstimateAreForgotten) {
  Dodger dodger(stereo());
  for (TimeUs t = 0; t < 1000000; t += kCycleUs) {
    dodger.add_range({t, 7});
    dodger.update(t);
  }
  EXPECT_FALSE(with_height_error(dodger, [](double) { return 0.0; }).landing);
}

}  // namespace
}  // namespace dodge
