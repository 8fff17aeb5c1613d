// A camera that turns and moves in the furnished room: pictures that are turned from others against
// pictures that are all drawn, and that eight times as often.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/event_rig.h"
#include "tests/closed_loop/flights.h"
#include "tests/sim/events/moving_plane.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;
using testing::compare;

struct Motion {
  Vector3d v_W, w_W;
};

class TurningCamera : public ::testing::Test {
 protected:
  TurningCamera() : world_({scenario("{}").models_dir, "room", "qav_rxl", {}}) {
    setup_.intrinsics = intrinsics(CameraSpec{});
    setup_.events = ideal_event_camera();
    setup_.cameras = 1;
    world_.reset(Vector3d(-2, 1, 2), 0, Vector3d::Zero());
  }

  Snapshot at(const Motion& motion, TimeUs t_us) const {
    Snapshot s = world_.snapshot();
    s.t_us = t_us;
    s.vehicle.p_W += seconds(t_us) * motion.v_W;
    s.vehicle.v_W = motion.v_W;
    s.vehicle.w_W = motion.w_W;
    s.vehicle.q_W = Eigen::AngleAxisd(seconds(t_us) * motion.w_W.norm(), motion.w_W.normalized());
    return s;
  }

  std::vector<Event> events(const Motion& motion, const SamplingSpec& sampling) {
    constexpr TimeUs kEndUs = 16000, kCycleUs = 4000;
    setup_.sampling = sampling;
    EventRig rig(world_, setup_);
    rig.start();
    std::vector<Event> events;
    for (TimeUs t = 0; t < kEndUs; t += kTickUs) {
      if (t % kCycleUs == 0) rig.require(t + kCycleUs);
      rig.advance(at(motion, t), at(motion, t + kTickUs), [&](int, const Packet& packet) {
        events.insert(events.end(), packet.events.begin(), packet.events.end());
      });
    }
    drawn_ = rig.drawn();
    turned_ = rig.turned();
    return events;
  }

  World world_;
  EventRigSetup setup_;
  std::int64_t drawn_ = 0, turned_ = 0;
};

SamplingSpec drawn_eight_times_as_often() {
  SamplingSpec spec;
  spec.max_displacement_px /= 8;
  spec.fast_displacement_px /= 8;
  spec.fast_interval_us = 1;
  spec.min_interval_us = 25;
  spec.max_turn_px = spec.max_displacement_px;
  spec.max_drift_px = 0;
  return spec;
}

TEST_F(TurningCamera, SeesMostlyTurnedPicturesAndNearlyTheEventsOfDrawnOnes) {
  const Motion motions[] = {{{0.5, 2, 0}, {8, 0, 0}}, {{2, 2, 1}, {5, 4, -4}}};
  for (const Motion& motion : motions) {
    const auto reference = events(motion, drawn_eight_times_as_often());
    EXPECT_EQ(turned_, 0);
    const auto turned = events(motion, SamplingSpec());
    EXPECT_LT(drawn_, 10);
    EXPECT_GT(turned_, 25);
    ASSERT_GT(reference.size(), 50000u);
    // Edges a pixel wide lose contrast where they are read between pixels.
    const auto difference = compare(turned, reference);
    EXPECT_LT(std::abs(difference.count), 0.15);
    EXPECT_LT(difference.median_us, 100);
    EXPECT_GT(difference.matched, 0.3);
  }
}

TEST_F(TurningCamera, IsDrawnEachTimeWhileItTurnsSlowly) {
  const Motion hover = {{0.03, -0.05, 0.02}, {0.02, -0.1, 0.05}};
  const auto difference =
      compare(events(hover, SamplingSpec()), events(hover, drawn_eight_times_as_often()));
  EXPECT_LT(std::abs(difference.count), 0.1);
  EXPECT_LT(difference.median_us, 100);
  EXPECT_GT(difference.matched, 0.6);
  events(hover, SamplingSpec());
  EXPECT_EQ(turned_, 0);
}

TEST_F(TurningCamera, IsDrawnMoreRarelyWhereDriftIsAllowed) {
  const Motion hover = {{0.03, -0.05, 0.02}, {0.02, -0.1, 0.05}};
  SamplingSpec drifting;
  drifting.max_drift_px = 0.1;
  const auto drawn = events(hover, SamplingSpec());
  const auto all_drawn = drawn_;
  const auto turned = events(hover, drifting);
  EXPECT_LT(drawn_, all_drawn);
  EXPECT_EQ(drawn_ + turned_, all_drawn);
  EXPECT_GT(turned.size(), drawn.size() / 4);
}

}  // namespace
}  // namespace dodgesim
