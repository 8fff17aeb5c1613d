#include "sim/bridge/truth_pilot.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "dodge/config.h"
#include "dodge/detect/tracker.h"
#include "sim/camera/looking_forward.h"

namespace dodgesim {
namespace {

constexpr TimeUs kDelayUs = 2000;  // of what happens at a packet's end: it goes with the next
constexpr double kSizeM = 0.2;
const Eigen::Vector3d kVehicle_p_W(1, -2, 3);
const Eigen::Vector3d kVehicle_v_W(0.4, 0.1, 0);
const Eigen::Vector3d kBall_v_W(-6, 0.5, 0.3);

dodge::Avoider avoider() {
  const dodge::Config core;
  return {core.repulsive, core.attractive, core.velocity_limit, core.escape};
}

// A camera 12 cm in front of the vehicle's centre, looking forward.
TruthPilot::Setup setup(int objects = 1) {
  TruthPilot::Setup out;
  out.delays.packet_us = 1000;
  out.delays.transport_us = 1000;
  out.latency_us = 100;
  out.lifetime_s = 0.5;
  out.sizes_m.assign(static_cast<std::size_t>(objects), kSizeM);
  out.X_BC.linear() = looking_forward();
  out.X_BC.translation() = Eigen::Vector3d(0.12, 0, 0);
  return out;
}

BodyState ball_at(const Eigen::Vector3d& p_W) {
  BodyState out;
  out.p_W = p_W;
  out.v_W = kBall_v_W;
  return out;
}

// The vehicle at its place, with no tilt, and balls in flight.
Snapshot scene(TimeUs t_us, const std::vector<Eigen::Vector3d>& balls_W) {
  Snapshot out;
  out.t_us = t_us;
  out.vehicle.p_W = kVehicle_p_W;
  for (const Eigen::Vector3d& p_W : balls_W) out.objects.push_back(ball_at(p_W));
  out.launched.assign(balls_W.size(), true);
  return out;
}

dodge::StateEstimate state_at(TimeUs t_us) {
  dodge::StateEstimate state;
  state.t_us = t_us;
  state.p_WB = kVehicle_p_W;
  state.v_WB = kVehicle_v_W;
  return state;
}

const dodge::Goal kGoal{{4, -2, 3}, 1.5};

// In front of the camera: forward, left, up from it.
Eigen::Vector3d from_camera(double forward, double left, double up) {
  return kVehicle_p_W + Eigen::Vector3d(0.12 + forward, left, up);
}

std::unique_ptr<TruthPilot> pilot(const TruthPilot::Setup& s) {
  auto out = std::make_unique<TruthPilot>(s, avoider());
  out->set_goal(kGoal);
  out->add_state(state_at(0));
  return out;
}

// A ball that flies from p_W to the vehicle.
Snapshot aimed(const Eigen::Vector3d& p_W) {
  Snapshot out = scene(0, {p_W});
  out.objects[0].v_W = 6 * (kVehicle_p_W - p_W).normalized();
  return out;
}

bool sees(const TruthPilot::Setup& s, const Eigen::Vector3d& p_W) {
  const auto p = pilot(s);
  p->observe(aimed(p_W), {});
  p->update(kDelayUs);
  return p->obstacles().size() == 1;
}

TEST(TruthPilot, StaysWhereItIsUntilItKnowsWhereThatIs) {
  TruthPilot pilot(setup(), avoider());
  pilot.set_goal(kGoal);
  EXPECT_EQ(pilot.update(4000).v_W, Eigen::Vector3d::Zero());
  pilot.add_state(state_at(6000));
  EXPECT_GT(pilot.update(8000).v_W.norm(), 0.1);
}

TEST(TruthPilot, SeesAnObjectWithItsTrueStateAfterTheDelay) {
  const auto p = pilot(setup());
  const Eigen::Vector3d ball_W = from_camera(2, 0.1, 0.2);
  p->observe(scene(1000, {ball_W}), {});
  p->update(1000 + kDelayUs - 1);
  EXPECT_TRUE(p->obstacles().empty());
  p->update(1000 + kDelayUs);
  ASSERT_EQ(p->obstacles().size(), 1u);
  const dodge::Obstacle& seen = p->obstacles()[0];
  EXPECT_EQ(seen.p_WO, ball_W);
  EXPECT_EQ(seen.v_WO, kBall_v_W);
  EXPECT_EQ(seen.size_m, kSizeM);
  EXPECT_EQ(seen.t_us, 1000);
}

// As a detection of a vehicle that believes to be elsewhere is elsewhere, too.
TEST(TruthPilot, SeesAnObjectInTheFrameOfTheStateEstimates) {
  const auto p = pilot(setup());
  const Eigen::Vector3d ball_W = from_camera(2, 0.1, 0.2);
  const FrameDrift drift{{0.3, -0.2, 0.7}, {0, 0, 0.5}};
  p->observe(scene(0, {ball_W}), drift);
  p->update(kDelayUs);
  ASSERT_EQ(p->obstacles().size(), 1u);
  EXPECT_EQ(p->obstacles()[0].p_WO, ball_W + drift.p_W);
  EXPECT_EQ(p->obstacles()[0].v_WO, kBall_v_W + drift.v_W);
}

// Each tick tells of itself by an event, which goes the way of those of a camera.
TEST(TruthPilot, KnowsWhatAnEventCouldTell) {
  constexpr TimeUs kEndUs = 30000;
  for (const int packet_us : {250, 900, 1000, 7000}) {
    for (const int transport_us : {0, 650, 1000, 9000}) {
      for (const int latency_us : {0, 100, 1300}) {
        TruthPilot::Setup s = setup();
        s.delays.packet_us = packet_us;
        s.delays.transport_us = transport_us;
        s.latency_us = latency_us;
        const auto p = pilot(s);
        std::map<TimeUs, TimeUs> tick_by_arrival;
        for (TimeUs now_us = 0; now_us <= kEndUs; now_us += kTickUs) {
          p->observe(scene(now_us, {from_camera(2, 0, 0)}), {});
          TimeUs packet_end_us = 0;
          while (packet_end_us < now_us + latency_us) packet_end_us += packet_us;
          tick_by_arrival[packet_end_us + transport_us] = now_us;
          p->update(now_us);
          const auto later = tick_by_arrival.upper_bound(now_us);
          ASSERT_EQ(p->obstacles().size(), later == tick_by_arrival.begin() ? 0u : 1u) << now_us;
          if (later == tick_by_arrival.begin()) continue;
          EXPECT_EQ(p->obstacles()[0].t_us, std::prev(later)->second) << now_us;
        }
      }
    }
  }
}

TEST(TruthPilot, AnObjectThatIsNotThrownYetIsNotThere) {
  const auto p = pilot(setup());
  Snapshot before = scene(0, {from_camera(2, 0, 0)});
  before.launched = {false};
  p->observe(before, {});
  p->update(kDelayUs);
  EXPECT_TRUE(p->obstacles().empty());
}

TEST(TruthPilot, CommandsWhatTheAvoiderDoesWithTheSameObstacle) {
  const auto p = pilot(setup());
  const Eigen::Vector3d ball_W = from_camera(1.5, 0.1, 0.05);
  p->observe(scene(0, {ball_W}), {});
  const dodge::VelocityCommand command = p->update(4000);
  const std::vector<dodge::TrackedObstacle> known = {
      dodge::known_obstacle(0, 0, ball_W, kBall_v_W, kSizeM)};
  const dodge::VelocityCommand expected = avoider().command(4000, state_at(0), kGoal, known);
  EXPECT_EQ(command.v_W, expected.v_W);
  EXPECT_EQ(command.t_us, expected.t_us);
  EXPECT_TRUE(command.evading);
  const dodge::VelocityCommand undisturbed = avoider().command(4000, state_at(0), kGoal, {});
  EXPECT_GT((command.v_W - undisturbed.v_W).norm(), 1);
}

TEST(TruthPilot, TheBlindOneOnlyFliesToTheGoal) {
  TruthPilot::Setup s = setup();
  s.blind = true;
  const auto p = pilot(s);
  for (TimeUs t_us = 0; t_us <= 8000; t_us += 1000) {
    p->observe(scene(t_us, {from_camera(0.5, 0, 0)}), {});
  }
  const dodge::VelocityCommand command = p->update(12000);
  EXPECT_TRUE(p->obstacles().empty());
  EXPECT_FALSE(command.evading);
  EXPECT_EQ(command.v_W, avoider().command(12000, state_at(0), kGoal, {}).v_W);
  EXPECT_NEAR(command.v_W.x(), kGoal.speed_mps, 1e-3);
}

TEST(TruthPilot, TheRangeIsMeasuredFromTheCamera) {
  TruthPilot::Setup s = setup();
  s.oracle.range_cap_m = 2;
  const Eigen::Vector3d direction = Eigen::Vector3d(3, -2, 1).normalized();
  const Eigen::Vector3d camera_W = from_camera(0, 0, 0);
  EXPECT_TRUE(sees(s, camera_W + 1.99 * direction));
  EXPECT_FALSE(sees(s, camera_W + 2.01 * direction));
  s.oracle.range_cap_m = 0;  // no cap
  EXPECT_TRUE(sees(s, camera_W + 50 * direction));
}

TEST(TruthPilot, TheRangeTurnsWithTheVehicle) {
  TruthPilot::Setup s = setup();
  s.oracle.range_cap_m = 2;
  const auto p = pilot(s);
  // Turned round, the camera is on the other side: 12 cm nearer to what is behind.
  Snapshot turned = aimed(kVehicle_p_W - Eigen::Vector3d(2.1, 0, 0));
  turned.vehicle.q_W = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ());
  p->observe(turned, {});
  p->update(kDelayUs);
  EXPECT_EQ(p->obstacles().size(), 1u);
  EXPECT_FALSE(sees(s, kVehicle_p_W - Eigen::Vector3d(2.1, 0, 0)));
}

TEST(TruthPilot, TheFieldOfViewIsTheImage) {
  TruthPilot::Setup s = setup();
  s.oracle.field_of_view = true;
  // The image ends 160 px beside and 120 px above or below the optical axis.
  const double side = 160 / s.intrinsics.f, height = 120 / s.intrinsics.f;
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(sees(s, from_camera(2, sign * 1.98 * side, 0)));
    EXPECT_FALSE(sees(s, from_camera(2, sign * 2.02 * side, 0)));
    EXPECT_TRUE(sees(s, from_camera(2, 0, sign * 1.98 * height)));
    EXPECT_FALSE(sees(s, from_camera(2, 0, sign * 2.02 * height)));
  }
  EXPECT_FALSE(sees(s, from_camera(-2, 0, 0)));
  s.oracle.field_of_view = false;
  EXPECT_TRUE(sees(s, from_camera(-2, 0, 0)));
}

TEST(TruthPilot, AnObjectThatIsNoLongerSeenIsRememberedAndDecays) {
  TruthPilot::Setup s = setup();
  s.oracle.range_cap_m = 2;
  const auto p = pilot(s);
  const Eigen::Vector3d near_W = from_camera(1.9, 0.1, 0.05);
  p->observe(scene(0, {near_W}), {});
  const auto push = [&](TimeUs now_us) {
    p->observe(scene(now_us, {from_camera(2.1, 0.1, 0.05)}), {});  // out of range from now on
    const dodge::VelocityCommand command = p->update(now_us + kDelayUs);
    return (command.v_W - avoider().command(now_us, state_at(0), kGoal, {}).v_W).norm();
  };
  const double early = push(20000);
  EXPECT_GT(early, 0.1);
  ASSERT_EQ(p->obstacles().size(), 1u);
  EXPECT_EQ(p->obstacles()[0].last_detection_us, 0);
  EXPECT_EQ(p->obstacles()[0].p_WO, near_W);
  const double late = push(400000);
  EXPECT_LT(late, 0.2 * early);
  p->update(500000);  // the lifetime to the microsecond
  EXPECT_EQ(p->obstacles().size(), 1u);
  const dodge::VelocityCommand after = p->update(500001);
  EXPECT_TRUE(p->obstacles().empty());
  EXPECT_FALSE(after.evading);
}

TEST(TruthPilot, AnObjectThatFliesAwayIsForgotten) {
  const auto p = pilot(setup());
  Snapshot truth = scene(0, {from_camera(2, 0.3, 0)});
  p->observe(truth, {});
  p->update(kDelayUs);
  ASSERT_EQ(p->obstacles().size(), 1u);
  truth.t_us = 4000;
  truth.objects[0].p_W = kVehicle_p_W + Eigen::Vector3d(-0.1, 0.3, 0);  // has passed
  p->observe(truth, {});
  p->update(4000 + kDelayUs);
  EXPECT_TRUE(p->obstacles().empty());
}

// A lob of 1 m/s, whose height changes faster than its distance: its distance grows for now.
TEST(TruthPilot, AnObjectThatRisesBeforeItFallsOnTheVehicleIsNotForgotten) {
  Snapshot truth = scene(0, {kVehicle_p_W + Eigen::Vector3d(2, 0, 0.5)});
  const auto known = [&](double v_z, double v_x) {
    truth.objects[0].v_W = Eigen::Vector3d(v_x, 0, v_z);
    const auto p = pilot(setup());
    p->observe(truth, {});
    p->update(kDelayUs);
    return p->obstacles().size();
  };
  EXPECT_EQ(known(9.6, -1), 1u);    // comes down on it after 2 s
  EXPECT_EQ(known(9.6, 1), 0u);     // comes down 4 m from it
  EXPECT_EQ(known(9.6, -0.1), 1u);  // 1.8 m from it, nearer than now
  EXPECT_EQ(known(2, 1), 0u);
}

TEST(TruthPilot, AnObjectThatIsOutrunIsNotForgotten) {
  const auto p = pilot(setup());
  Snapshot truth = scene(0, {from_camera(2, 0.3, 0)});
  truth.vehicle.v_W = Eigen::Vector3d(-8, 0, 0);
  p->observe(truth, {});
  p->update(kDelayUs);
  EXPECT_EQ(p->obstacles().size(), 1u);
}

TEST(TruthPilot, AnObjectThatTheVehicleCatchesUpWithIsNotForgotten) {
  const auto p = pilot(setup());
  Snapshot truth = scene(0, {from_camera(1, 0.1, 0)});
  truth.objects[0].v_W = Eigen::Vector3d(3, 0, 0);
  truth.vehicle.v_W = Eigen::Vector3d(5, 0, 0);
  p->observe(truth, {});
  p->update(kDelayUs);
  EXPECT_EQ(p->obstacles().size(), 1u);
}

TEST(TruthPilot, AnObjectOutOfViewIsNotKnownToFlyAway) {
  TruthPilot::Setup s = setup();
  s.oracle.field_of_view = true;
  const auto p = pilot(s);
  Snapshot truth = scene(0, {from_camera(2, 0.3, 0)});
  p->observe(truth, {});
  p->update(kDelayUs);
  truth.t_us = 4000;
  truth.objects[0].p_W = kVehicle_p_W + Eigen::Vector3d(-0.5, 0.3, 0);  // behind the camera
  p->observe(truth, {});
  p->update(4000 + kDelayUs);
  EXPECT_EQ(p->obstacles().size(), 1u);
}

TEST(TruthPilot, KeepsSeveralObjectsApart) {
  const auto p = pilot(setup(3));
  std::vector<Eigen::Vector3d> balls_W = {from_camera(2, 0, 0), from_camera(3, 1, 0),
                                          from_camera(1, -1, 0)};
  Snapshot first = scene(0, balls_W);
  first.launched[0] = false;
  p->observe(first, {});
  p->update(4000);
  ASSERT_EQ(p->obstacles().size(), 2u);
  for (Eigen::Vector3d& p_W : balls_W) p_W.x() -= 0.05;
  p->observe(scene(8000, balls_W), {});
  p->update(12000);
  ASSERT_EQ(p->obstacles().size(), 3u);
  for (const dodge::Obstacle& o : p->obstacles()) {
    EXPECT_EQ(o.p_WO, balls_W[static_cast<std::size_t>(o.id)]);
    EXPECT_EQ(o.t_us, 8000);
  }
}

}  // namespace
}  // namespace dodgesim
