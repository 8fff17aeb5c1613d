// Why events happen, as the cameras on the vehicle say, and what follows about the detection.
#include "sim/observers/event_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "sim/flight/setup.h"
#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

// A vehicle that moves as it is told in front of the room, and a ball.
class CausesTest : public ::testing::Test {
 protected:
  CausesTest() : world_({scenario("{}").models_dir, "room", "qav_rxl", {{"ball", 0.2}}}) {
    setup_.intrinsics = intrinsics(CameraSpec{});
    setup_.events = event_camera_preset("ideal");
    setup_.cameras = 1;
    setup_.keep_causes = true;
  }

  // Counts the events of 20 ms by cause.
  std::map<Cause, int> film(const Vector3d& ball_v_W, double yaw_rate_radps) {
    world_.reset({-2, 0, 2}, 0, Vector3d::Zero());
    BodyState ball;
    ball.p_W = {-0.2, 0.1, 2.1};
    world_.launch(0, ball);
    EventRig rig(world_, setup_);
    rig.start();
    std::map<Cause, int> counts;
    Snapshot now = world_.snapshot();
    for (int tick = 1; tick <= 80; ++tick) {
      Snapshot next = world_.snapshot();
      next.t_us = tick * kTickUs;
      next.objects[0].v_W = ball_v_W;
      next.objects[0].p_W = ball.p_W + seconds(next.t_us) * ball_v_W;
      next.vehicle.w_W = {0, 0, yaw_rate_radps};
      next.vehicle.q_W = Eigen::AngleAxisd(seconds(next.t_us) * yaw_rate_radps, Vector3d::UnitZ());
      rig.advance(now, next, [&](int, const Packet& packet) {
        EXPECT_EQ(packet.causes.size(), setup_.keep_causes ? packet.events.size() : 0);
        for (const Cause cause : packet.causes) ++counts[cause];
      });
      now = next;
    }
    hash_ = rig.events_hash();
    return counts;
  }

  World world_;
  EventRigSetup setup_;
  std::uint64_t hash_ = 0;
};

TEST_F(CausesTest, OfACameraAtRestAreAllTheMovingObject) {
  for (const double speed_mps : {0.5, 2.0, 6.0}) {
    auto counts = film({0, speed_mps, 0.3 * speed_mps}, 0);
    EXPECT_GT(counts[kCauseFirstObject], 40);
    EXPECT_EQ(counts.size(), 1u) << speed_mps;
  }
}

TEST_F(CausesTest, OfATurningCameraAreTheSceneAndTheObjectInIt) {
  auto counts = film(Vector3d::Zero(), 2);
  EXPECT_GT(counts[kCauseScene], 5000);
  EXPECT_GT(counts[kCauseFirstObject], 50);
  EXPECT_LT(counts[kCauseFirstObject], 0.1 * counts[kCauseScene]);
}

TEST_F(CausesTest, AreNoiseOfEachKindWhereNothingMoves) {
  setup_.events = event_camera_preset("sees1");
  setup_.events.hot_pixel_fraction = 0.01;
  auto counts = film(Vector3d::Zero(), 0);
  EXPECT_EQ(counts[kCauseScene] + counts[kCauseFirstObject], 0);
  EXPECT_GT(counts[kCauseLeak], 5);  // shot noise resets nearly all before
  EXPECT_GT(counts[kCauseShotNoise], 50);
  EXPECT_GT(counts[kCauseHotPixel], 500);
}

TEST_F(CausesTest, DoNotChangeTheEvents) {
  setup_.events = event_camera_preset("sees1");
  film({-4, 2, 0}, 1);
  const std::uint64_t with = hash_;
  setup_.keep_causes = false;
  EXPECT_TRUE(film({-4, 2, 0}, 1).empty());
  EXPECT_EQ(hash_, with);
}

// One ball passes in front of another.
TEST(CausesOfSeveralObjects, DoNotDependOnTheirOrder) {
  EventRigSetup setup;
  setup.intrinsics = intrinsics(CameraSpec{});
  setup.events = event_camera_preset("ideal");
  setup.cameras = 1;
  setup.keep_causes = true;
  const auto film = [&](bool swapped) {
    World world({scenario("{}").models_dir, "room", "qav_rxl", {{"ball", 0.2}, {"ball", 0.2}}});
    world.reset({-2, 0, 2}, 0, Vector3d::Zero());
    std::array<BodyState, 2> balls;  // the near one, then the far one
    balls[0].p_W = {-0.6, 0.15, 2.05};
    balls[0].v_W = {0, -4, 0};
    balls[1].p_W = {0.2, -0.05, 2.1};
    balls[1].v_W = {0, 3, 0};
    if (swapped) std::swap(balls[0], balls[1]);
    for (int i = 0; i < 2; ++i) world.launch(i, balls[static_cast<std::size_t>(i)]);
    EventRig rig(world, setup);
    rig.start();
    std::vector<int> near;  // whether each event is the near ball's
    Snapshot now = world.snapshot();
    for (int tick = 1; tick <= 80; ++tick) {
      Snapshot next = world.snapshot();
      next.t_us = tick * kTickUs;
      for (std::size_t i = 0; i < 2; ++i) {
        next.objects[i].v_W = balls[i].v_W;
        next.objects[i].p_W = balls[i].p_W + seconds(next.t_us) * balls[i].v_W;
      }
      rig.advance(now, next, [&](int, const Packet& packet) {
        for (const Cause cause : packet.causes) {
          near.push_back(cause == kCauseFirstObject + (swapped ? 1 : 0));
        }
      });
      now = next;
    }
    return near;
  };
  const std::vector<int> near = film(false);
  EXPECT_GT(std::count(near.begin(), near.end(), 1), 1000);
  EXPECT_GT(std::count(near.begin(), near.end(), 0), 1000);
  EXPECT_TRUE(near == film(true));
}

// Checks each cycle against the pilot's own counts.
class CheckedTruth : public EventTruth {
 public:
  void on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) override {
    EventTruth::on_dodger_cycle(now_us, dodger);
    for (int camera = 0; camera < 2; ++camera) {
      EXPECT_EQ(dodger.dropped_events(camera), 0);
      std::map<int, int> count;  // by compensated pixel
      int found = 0, clustered = 0;
      for (const WindowEvent& event : window(camera)) {
        if (event.pixel >= 0) ++count[event.pixel];
        found += event.found ? 1 : 0;
        labelled_ += event.cause != kCauseScene ? 1 : 0;
      }
      const dodge::StageImages& stages = dodger.stage_images(camera);
      for (const auto& [pixel, n] : count) {
        EXPECT_EQ(stages.count(pixel / stages.count.cols, pixel % stages.count.cols), n);
      }
      EXPECT_EQ(cv::countNonZero(stages.count), static_cast<int>(count.size()));
      for (const dodge::Cluster& cluster : dodger.clusters(camera)) clustered += cluster.events;
      // Groups too small for a cluster may lie in the rectangle of one.
      EXPECT_GE(found, clustered);
      EXPECT_LE(found, 1.2 * clustered);
      clustered_ += clustered;
    }
  }
  int labelled_ = 0, clustered_ = 0;
};

TEST(EventTruth, DoesNotChangeTheFlightAmongSeveralObjects) {
  const Scenario two = scenario(
      "seed: 12\npilot: falanga2020\nmission: {start_m: [-2, 0, 2]}\nfly_oracle: false\n"
      "after_s: 0.1\nthrows: [{size_m: 0.2, launch_s: 0.2, bearing_deg: 15},\n"
      "  {size_m: 0.2, launch_s: 0.2, bearing_deg: -15}]\n"
      "sensors: {camera: {width: 160, height: 120}}\ndodger: {position: {max_range_m: 3}}\n");
  const FlightPlan plan = plan_throw(two, 0);
  EventTruth truth;
  const FlightRecord watched = fly(two, plan, &truth);
  EXPECT_TRUE(watched.first_command_us.has_value());  // also while it evades
  EXPECT_EQ(watched.events_hash, fly(two, plan).events_hash);
}

TEST(EventTruth, AgreesWithThePilotsWindowsAndFindsTheBall) {
  const Scenario s = scenario(
      "mission: {start_m: [-2, 0, 2]}\n"
      "throw: {distance_m: 3, speed_mps: 5, size_m: 0.2, launch_height_m: 1.7, launch_s: 0.2}\n"
      "dodger: {position: {max_range_m: 3}, repulsive: {k_r0: 0.01}}\n");  // it stays
  FlightPlan plan = plan_throw(s, 0);
  plan.end_us = plan.launches.at(0).drawn.launch_us + 350000;
  CheckedTruth truth;
  const FlightRecord watched = fly(s, plan, &truth);
  EXPECT_GT(truth.labelled_, 1000);
  EXPECT_GT(truth.clustered_, 300);
  ASSERT_FALSE(truth.rows().empty());
  EXPECT_GE(truth.rows().front().cycle_us, plan.launches.at(0).drawn.launch_us);
  EXPECT_FALSE(truth.rows().front().evading);

  EventTruthSums sums;
  sums.add(truth.rows());
  const EventTruthCounts& before = sums.before;
  EXPECT_GT(before.precision().value_or(0), 0.5);  // a hovering vehicle sees little else
  EXPECT_GT(before.recall().value_or(0), 0.14);    // half of what it is
  EXPECT_LE(before.found_object_events, std::min(before.found_events, before.object_events));
  EXPECT_LE(std::max(before.found_events, before.object_events), before.events);

  EXPECT_EQ(fly(s, plan).events_hash, watched.events_hash);  // who watches changes nothing
}

}  // namespace
}  // namespace dodgesim
