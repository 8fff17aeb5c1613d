// Both event cameras on the vehicle: geometry, polarity, packets. A ball far from any furniture,
// with cameras without noise.
#include "sim/flight/event_rig.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include "sim/flight/setup.h"
#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

const Vector3d kVehicle_p_W(-2, 0, 2);
constexpr double kBaselineM = 0.15;

struct Packed {
  int camera;
  TimeUs known_us;  // end of the tick in which it came
  TimeUs end_us;
  std::vector<Event> events;
};

// Mean place of events, with their number.
struct Centroid {
  double x = 0, y = 0;
  int count = 0;
};

template <class Which>
Centroid centroid(const std::vector<Event>& events, Which which) {
  Centroid out;
  for (const Event& e : events) {
    if (!which(e)) continue;
    out.x += e.x;
    out.y += e.y;
    ++out.count;
  }
  out.x /= out.count;
  out.y /= out.count;
  return out;
}

Centroid centroid(const std::vector<Event>& events) {
  return centroid(events, [](const Event&) { return true; });
}

// A vehicle that stands still in the air, its cameras, and a ball that moves as it is told: the
// physics advance only the time.
class RigTest : public ::testing::Test {
 protected:
  RigTest() : world_({scenario("{}").models_dir, "room", "qav_rxl", {{"ball", 0.2}}}) {
    setup_.intrinsics = intrinsics(CameraSpec{});
    setup_.events = event_camera_preset("ideal");
    world_.reset(kVehicle_p_W, 0, Vector3d::Zero());
  }

  void make_rig() { rig_ = std::make_unique<EventRig>(world_, setup_); }

  // Where the optical axis of the camera in the middle between both meets a plane `depth` away,
  // moved left and up.
  Vector3d place(double depth_m, double left_m = 0, double up_m = 0) const {
    const Vector3d middle_B =
        0.5 * (world_.vehicle().X_BC[0].translation() + world_.vehicle().X_BC[1].translation());
    return kVehicle_p_W + middle_B + Vector3d(depth_m, left_m, up_m);
  }

  void launch(const Vector3d& p_W) {
    ball_.p_W = p_W;
    world_.launch(0, ball_);
    now_ = world_.snapshot();
  }

  // Moves the ball in a straight line for a number of ticks. The events of each camera.
  std::array<std::vector<Event>, 2> move(const Vector3d& v_W, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      Snapshot next = now_;
      next.t_us += kTickUs;
      if (next.launched[0]) {
        next.objects[0].v_W = v_W;
        next.objects[0].p_W += seconds(kTickUs) * v_W;
      }
      if (before_tick) before_tick(next.t_us);
      rig_->advance(now_, next, [&](int camera, const Packet& packet) {
        packets_.push_back(
            {camera, next.t_us, packet.end_us, {packet.events.begin(), packet.events.end()}});
      });
      now_ = next;
    }
    std::array<std::vector<Event>, 2> events;
    for (const Packed& p : packets_) {
      auto& all = events[static_cast<std::size_t>(p.camera)];
      all.insert(all.end(), p.events.begin(), p.events.end());
    }
    return events;
  }

  std::array<std::vector<Event>, 2> show(const Vector3d& p_W, const Vector3d& v_W, int ticks = 40) {
    make_rig();
    rig_->start();
    launch(p_W);
    rig_->rebase();
    return move(v_W, ticks);
  }

  World world_;
  EventRigSetup setup_;
  std::unique_ptr<EventRig> rig_;
  BodyState ball_;
  Snapshot now_;
  std::vector<Packed> packets_;
  std::function<void(TimeUs)> before_tick;
};

TEST_F(RigTest, SeesABallWhereThePinholeModelPutsItAndTheTopCameraSeesItLower) {
  // Up and down by as much: the mean place of its events is its centre, up to the pattern.
  const double depth_m = 2;
  const auto events = show(place(depth_m, 0, -0.02), {0, 0, 4}, 40);
  const Centroid top = centroid(events[0]), bottom = centroid(events[1]);
  const double f = setup_.intrinsics.f, cy = setup_.intrinsics.cy();
  const double disparity_px = f * kBaselineM / depth_m;  // 14.3
  ASSERT_GT(top.count, 100);
  ASSERT_GT(bottom.count, 100);
  EXPECT_NEAR(top.y, cy + 0.5 * disparity_px, 2.5);
  EXPECT_NEAR(bottom.y, cy - 0.5 * disparity_px, 2.5);
  EXPECT_NEAR(top.y - bottom.y, disparity_px, 2.5);
  EXPECT_NEAR(top.x, setup_.intrinsics.cx(), 2.5);
  EXPECT_NEAR(top.x, bottom.x, 1.5);
}

TEST_F(RigTest, DisparityFallsWithTheDistance) {
  const auto near = show(place(1, 0, -0.02), {0, 0, 4}, 40);
  packets_.clear();
  world_.reset(kVehicle_p_W, 0, Vector3d::Zero());
  const auto far = show(place(4, 0, -0.02), {0, 0, 4}, 40);
  const auto disparity = [](const auto& events) {
    return centroid(events[0]).y - centroid(events[1]).y;
  };
  const double f = setup_.intrinsics.f;
  EXPECT_NEAR(disparity(near), f * kBaselineM / 1, 4);
  EXPECT_NEAR(disparity(far), f * kBaselineM / 4, 2);
}

TEST_F(RigTest, WhatIsToTheLeftHasSmallerColumns) {
  const auto events = show(place(2, 0.5, 0), {0, 3, 0});
  const double x = setup_.intrinsics.cx() - setup_.intrinsics.f * 0.5 / 2;
  for (int i = 0; i < 2; ++i) {
    const std::vector<Event>& all = events[static_cast<std::size_t>(i)];
    EXPECT_NEAR(centroid(all).x, x - 1.4, 4);
    const auto early = centroid(all, [](const Event& e) { return e.t_us <= 5000; });
    const auto late = centroid(all, [](const Event& e) { return e.t_us > 5000; });
    EXPECT_LT(late.x, early.x - 0.5);  // and goes on to the left
  }
}

TEST_F(RigTest, WhatIsHighHasSmallerRows) {
  const auto events = show(place(2, 0, 0.4), {0, 0, 3});
  const double y = setup_.intrinsics.cy() - setup_.intrinsics.f * 0.4 / 2;
  EXPECT_NEAR(0.5 * (centroid(events[0]).y + centroid(events[1]).y), y - 1.4, 4);
  const auto early = centroid(events[0], [](const Event& e) { return e.t_us <= 5000; });
  const auto late = centroid(events[0], [](const Event& e) { return e.t_us > 5000; });
  EXPECT_LT(late.y, early.y - 0.5);
}

TEST_F(RigTest, TheEdgeThatCoversADarkerBackgroundFiresOn) {
  // Which way a pixel changes where the ball has come, taken from the pictures before and after.
  make_rig();
  rig_->start();
  launch(place(2, 0.4, 0));
  rig_->rebase();
  const std::vector<float> before = rig_->luminance(0);
  const auto events = move({0, -4, 0}, 40);  // to the right, by 3.8 px
  const std::vector<float>& after = rig_->luminance(0);
  int right = 0, wrong = 0;
  std::map<std::size_t, int> sum;
  for (const Event& e : events[0]) {
    sum[static_cast<std::size_t>(e.y * setup_.intrinsics.width + e.x)] += e.polarity;
  }
  for (const auto& [pixel, polarity] : sum) {
    const double change = std::log(after[pixel] + 1e-3) - std::log(before[pixel] + 1e-3);
    if (std::abs(change) < 0.4) continue;
    ++((change > 0) == (polarity > 0) ? right : wrong);
  }
  EXPECT_GT(right, 100);
  EXPECT_EQ(wrong, 0);
}

TEST_F(RigTest, ALaunchMakesNoEvents) {
  make_rig();
  rig_->start();
  now_ = world_.snapshot();
  move(Vector3d::Zero(), 20);
  launch(place(1.5));
  now_.t_us = 20 * kTickUs;
  rig_->rebase();
  const auto still = move(Vector3d::Zero(), 40);
  EXPECT_TRUE(still[0].empty());
  EXPECT_TRUE(still[1].empty());
  EXPECT_EQ(rig_->event_count(0), 0);
  const auto moving = move({0, 2, 0}, 20);
  EXPECT_GT(moving[0].size(), 50u);
  EXPECT_GT(rig_->event_count(1), 50);
}

TEST_F(RigTest, WithoutARebaseTheLaunchWouldMakeEvents) {
  make_rig();
  rig_->start();
  launch(place(1.5));
  const auto events = move(Vector3d::Zero(), 40);
  EXPECT_GT(events[0].size(), 200u);
}

TEST_F(RigTest, PacketsHoldTheEventsOfTheirPeriodInOrder) {
  setup_.packet_us = 500;
  show(place(1.5), {-3, 2, 0}, 60);
  ASSERT_GT(packets_.size(), 20u);
  std::array<TimeUs, 2> last{-1, -1};
  for (const Packed& p : packets_) {
    EXPECT_EQ(p.end_us % 500, 0);
    EXPECT_LE(p.end_us, p.known_us);
    TimeUs& last_us = last[static_cast<std::size_t>(p.camera)];
    for (const Event& e : p.events) {
      EXPECT_GT(e.t_us, p.end_us - 500);
      EXPECT_LE(e.t_us, p.end_us);
      EXPECT_GE(e.t_us, last_us);
      last_us = e.t_us;
    }
  }
}

TEST_F(RigTest, APacketIsCompleteAtTheInstantThatIsRequired) {
  // Slow motion: samples come seldom, and only what is required comes in time.
  const auto known = [&](bool require) {
    packets_.clear();
    world_.reset(kVehicle_p_W, 0, Vector3d::Zero());
    before_tick = [this, require](TimeUs tick_us) {
      if (require && tick_us % 2000 == 0) rig_->require(tick_us);
    };
    show(place(1.5), {0, 0.1, 0}, 400);
    int late = 0;
    for (const Packed& p : packets_) late += p.end_us % 2000 == 0 && p.known_us > p.end_us;
    return late;
  };
  EXPECT_EQ(known(true), 0);
  EXPECT_GT(known(false), 0);
}

TEST_F(RigTest, TheSameMotionGivesTheSameEvents) {
  setup_.events = EventCameraSpec{};
  const auto hash = [&](std::uint64_t throw_index) {
    setup_.throw_index = throw_index;
    world_.reset(kVehicle_p_W, 0, Vector3d::Zero());
    show(place(1.5), {0, 2, 0}, 20);
    return rig_->events_hash();
  };
  const std::uint64_t first = hash(3);
  EXPECT_NE(first, hash(4));  // other noise
  EXPECT_EQ(first, hash(3));
}

TEST_F(RigTest, CountsTheEventsThatASlowReadoutLoses) {
  const auto count = [&](double readout_max_hz) {
    setup_.events.readout_max_hz = readout_max_hz;
    world_.reset(kVehicle_p_W, 0, Vector3d::Zero());
    show(place(1.5), {0, 3, 0}, 40);
    return std::pair(rig_->event_count(0), rig_->lost_count(0));
  };
  const auto [all, none_lost] = count(0);
  EXPECT_EQ(none_lost, 0);
  const auto [served, lost] = count(2e4);
  EXPECT_LE(static_cast<double>(served), 2e4 * seconds(40 * 500) + 1);
  EXPECT_GT(lost, 0);
  EXPECT_LT(served + lost, all);  // others still wait
}

TEST_F(RigTest, AFlickeringLightMakesEveryPixelFireWithIt) {
  setup_.render.flicker = {100, 0.5};  // log luminance from -0.69 to 0.41: 5 events up, 5 down
  const auto events = show(place(1.5), Vector3d::Zero(), 160)[0];  // four periods
  const double pixels = setup_.intrinsics.width * setup_.intrinsics.height;
  double on = 0;
  for (const Event& e : events) on += e.polarity > 0;
  const double off = static_cast<double>(events.size()) - on;
  EXPECT_NEAR(on / pixels, 4 * 5, 3);
  EXPECT_NEAR(off / pixels, 4 * 5, 3);
  // All ON in one half of the period, all OFF in the other, up to the phase of the throw.
  std::vector<int> signs;
  std::array<double, 20> balance{};
  for (const Event& e : events) balance[static_cast<std::size_t>(e.t_us / 500 % 20)] += e.polarity;
  for (const double b : balance) {
    if (b != 0) signs.push_back(b > 0 ? 1 : -1);
  }
  int changes = signs.front() != signs.back();
  for (std::size_t i = 1; i < signs.size(); ++i) changes += signs[i] != signs[i - 1];
  EXPECT_EQ(changes, 2);
  EXPECT_GE(rig_->pictures(), 2 * 79);  // 20 pictures a period and camera
}

TEST_F(RigTest, TheFlickersPhaseDiffersFromThrowToThrow) {
  setup_.render.flicker = {100, 0.5};
  const auto first_us = [&](std::uint64_t throw_index) {
    setup_.throw_index = throw_index;
    packets_.clear();
    world_.reset(kVehicle_p_W, 0, Vector3d::Zero());
    const auto events = show(place(1.5), Vector3d::Zero(), 40)[0];
    return events.empty() ? 0 : events.front().t_us * events.front().polarity;
  };
  EXPECT_EQ(first_us(0), first_us(0));
  EXPECT_NE(first_us(0), first_us(1));
}

TEST_F(RigTest, OneCameraIsEnoughForMono) {
  setup_.cameras = 1;
  const auto events = show(place(1.5), {0, 2, 0}, 20);
  EXPECT_GT(events[0].size(), 50u);
  EXPECT_TRUE(events[1].empty());
  EXPECT_EQ(rig_->event_count(1), 0);
}

}  // namespace
}  // namespace dodgesim
