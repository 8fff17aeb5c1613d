// A rig that moves and turns fast in the furnished room, with a ball in view: the room seen from
// pictures drawn nearby against the room drawn anew for every picture.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/flight/event_rig.h"
#include "sim/flight/setup.h"
#include "sim/world/ray.h"
#include "tests/closed_loop/flights.h"
#include "tests/sim/events/moving_plane.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;
using testing::compare;

struct Motion {
  Vector3d v_W, w_W;
};

// What one camera of a rig saw of a motion, a tick at a time.
struct Seen {
  std::vector<Event> events;
  std::vector<int> count;  // of the events of each tick
  std::vector<bool> drew;  // whether a key was drawn in it
  std::int64_t keys, pictures, regions;
};

class MovingRig : public ::testing::Test {
 protected:
  MovingRig() : world_({scenario("{}").models_dir, "room", "qav_rxl", {{"ball", 0.2}}}) {
    setup_.intrinsics = intrinsics(CameraSpec{});
    setup_.events = event_camera_preset("ideal");
    setup_.cameras = 1;
    setup_.packet_us = kTickUs;
    world_.reset(Vector3d(-2, 0.5, 2), 0.2, Vector3d::Zero());
    ball_.p_W = {0.3, 0.8, 2.1};
    ball_.v_W = {-5, 0, 1};
    world_.launch(0, ball_);
  }

  Snapshot at(const Motion& motion, TimeUs t_us) const {
    Snapshot s = world_.snapshot();
    s.t_us = t_us;
    s.vehicle.p_W += seconds(t_us) * motion.v_W;
    s.vehicle.v_W = motion.v_W;
    s.vehicle.w_W = motion.w_W;
    s.vehicle.q_W = Eigen::AngleAxisd(seconds(t_us) * motion.w_W.norm(), motion.w_W.normalized()) *
                    s.vehicle.q_W;
    s.objects[0].p_W += seconds(t_us) * s.objects[0].v_W;
    return s;
  }

  // A whole picture at least every period_us.
  Seen see(const Motion& motion, const KeySpec& keys, TimeUs end_us = 24000,
           TimeUs period_us = kTickUs) {
    setup_.keys = keys;
    EventRig rig(world_, setup_);
    rig.start();
    Seen seen;
    for (TimeUs t = 0; t < end_us; t += kTickUs) {
      if (t % period_us == 0) rig.require(t + period_us);
      const std::int64_t keys_before = rig.keys();
      const std::size_t events_before = seen.events.size();
      rig.advance(at(motion, t), at(motion, t + kTickUs), [&](int, const Packet& packet) {
        seen.events.insert(seen.events.end(), packet.events.begin(), packet.events.end());
      });
      seen.count.push_back(static_cast<int>(seen.events.size() - events_before));
      seen.drew.push_back(rig.keys() > keys_before);
    }
    seen.keys = rig.keys();
    seen.pictures = rig.pictures();
    seen.regions = rig.regions();
    return seen;
  }

  World world_;
  EventRigSetup setup_;
  BodyState ball_;
};

KeySpec every_picture() {
  KeySpec spec;
  spec.max_misplacement_px = 0;
  return spec;
}

const Motion kMotions[] = {{{0, 2, 0}, {0, 0, 5}}, {{1.2, -1.2, 1}, {3, -3, -2.5}}};

// The ticks with a new key must not have more events than a rig has that draws them all.
void expect_no_bursts(const Seen& seen, const Seen& anew) {
  int with_key = 0, expected = 0, keys = 0;
  for (std::size_t i = 0; i < seen.drew.size(); ++i) {
    if (!seen.drew[i]) continue;
    with_key += seen.count[i];
    expected += anew.count[i];
    ++keys;
  }
  ASSERT_GE(keys, 4);
  EXPECT_LT(with_key, 1.2 * expected);
}

TEST_F(MovingRig, SeesNearlyTheEventsOfARigThatDrawsTheRoomForEveryPicture) {
  KeySpec narrow;  // the margin is small, so that there are many keys
  narrow.margin_px = 8;
  narrow.max_misplacement_px = 0.5;
  for (const Motion& motion : kMotions) {
    const Seen anew = see(motion, every_picture());
    EXPECT_GE(anew.keys, anew.pictures);
    const Seen seen = see(motion, KeySpec());
    EXPECT_EQ(seen.pictures, anew.pictures);
    EXPECT_EQ(seen.regions, anew.regions);
    EXPECT_LT(seen.keys, anew.keys / 10);
    ASSERT_GT(anew.events.size(), 30000u);
    const auto difference = compare(seen.events, anew.events);
    // Which of two neighbours fires differs where the finest texture is read between the means.
    EXPECT_LT(std::abs(difference.count), 0.02);
    EXPECT_LT(difference.median_us, 50);
    EXPECT_GT(difference.matched, 0.45);
    expect_no_bursts(see(motion, narrow), anew);
  }
}

TEST_F(MovingRig, SeesThemTheBetterTheFinerTheRoomIsDrawn) {
  const Motion& motion = kMotions[0];
  KeySpec fine, fine_every = every_picture();
  fine.supersampling = fine_every.supersampling = 4;
  const auto difference =
      compare(see(motion, fine, 12000).events, see(motion, fine_every, 12000).events);
  EXPECT_LT(std::abs(difference.count), 0.02);
  EXPECT_LT(difference.median_us, 15);
  EXPECT_GT(difference.matched, 0.7);
}

const Motion kStill = {Vector3d::Zero(), Vector3d::Zero()};

// Sampled so densely that it does not matter which instants they are.
TEST_F(MovingRig, AtRestSeesTheBallByItsRegionsAsByWholePictures) {
  setup_.sampling.max_displacement_px /= 8;
  setup_.sampling.min_interval_us = 50;
  const Seen by_region = see(kStill, KeySpec(), 100000, 4000);
  const Seen by_picture = see(kStill, KeySpec(), 100000);
  EXPECT_GT(by_region.regions, 150);
  EXPECT_EQ(by_region.keys, 1);
  ASSERT_GT(by_picture.events.size(), 1000u);
  const auto difference = compare(by_region.events, by_picture.events);
  EXPECT_LT(std::abs(difference.count), 0.005);
  EXPECT_LT(difference.median_us, 10);
  EXPECT_GT(difference.matched, 0.85);
}

TEST_F(MovingRig, SeesABallInFrontOfAWallAndNoneBehindIt) {
  const Eigen::Isometry3d X_WC = world_.snapshot().vehicle.pose() * world_.vehicle().X_BC[0];
  const Vector3d along = X_WC.linear().col(2);
  const auto wall = first_along(world_, X_WC.translation(), along, kRoomGroup + 1);
  ASSERT_TRUE(wall);
  const auto events_at = [&](double distance_m) {
    ball_.p_W = X_WC.translation() + distance_m * along;
    ball_.v_W = {0, 2, 0};
    world_.launch(0, ball_);
    return see(kStill, KeySpec(), 40000, 4000).events.size();
  };
  EXPECT_GT(events_at(wall->distance - 0.3), 20u);
  EXPECT_EQ(events_at(wall->distance + 0.3), 0u);
}

}  // namespace
}  // namespace dodgesim
