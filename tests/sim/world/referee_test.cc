#include "sim/world/referee.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "sim/base/random.h"
#include "sim/world/throw.h"
#include "tests/models.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

void fly(World& world, Referee& referee, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    world.step(hover(world));
    referee.observe(world);
  }
}

// Truth about the distance from a point to the vehicle's hull: to the boxes of the model file.
double point_to_hull(const Vector3d& p_B) {
  const Vector3d centres[] = {{0, 0, 0}, {0.103, 0, 0.075}, {0.103, 0, -0.075}};
  const Vector3d halves[] = {{0.17, 0.17, 0.05}, {0.015, 0.0175, 0.0175}, {0.015, 0.0175, 0.0175}};
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    best = std::min(best, ((p_B - centres[k]).cwiseAbs() - halves[k]).cwiseMax(0).norm());
  }
  return best;
}

// Of the only object, now.
double clearance_m(const World& world, Referee& referee) {
  referee.reset();
  referee.observe(world);
  return referee.verdict().objects.at(0).clearance_m;
}

TEST(RefereeTest, ClearanceOfABallIsTheDistanceToTheHullLessItsRadius) {
  RandomStream random(1, 0, "referee");
  World world(test_spec({{"ball", 0.2}}));
  Referee referee(world);
  for (int i = 0; i < 500; ++i) {
    world.reset(kStart, random.uniform(-3, 3), Vector3d::Zero());
    const Vector3d p_B(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.6, 0.6));
    const Vector3d p_W = world.snapshot().vehicle.pose() * p_B;
    world.launch(0, thrown(p_W, Vector3d::Zero()));
    EXPECT_NEAR(clearance_m(world, referee), std::max(0.0, point_to_hull(p_B) - 0.1), 1e-6);
  }
}

TEST(RefereeTest, ClearanceOfABoxAgreesWithSampledSurfacePoints) {
  RandomStream random(2, 0, "referee");
  World world(test_spec({{"box", 0.3}}));
  Referee referee(world);
  const Vector3d half(0.15, 0.1, 0.075);
  for (int i = 0; i < 20; ++i) {
    BodyState state;
    state.q_W =
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
            .normalized();
    state.p_W =
        Vector3d(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), random.uniform(-0.5, 0.5)) +
        kStart;
    world.reset(kStart, 0, Vector3d::Zero());
    world.launch(0, state);
    double sampled = std::numeric_limits<double>::infinity();
    constexpr int kN = 60;
    for (int axis = 0; axis < 3; ++axis) {
      for (int a = -kN; a <= kN; ++a) {
        for (int b = -kN; b <= kN; ++b) {
          for (int sign = -1; sign <= 1; sign += 2) {
            Vector3d p;
            p[axis] = sign * half[axis];
            p[(axis + 1) % 3] = half[(axis + 1) % 3] * a / kN;
            p[(axis + 2) % 3] = half[(axis + 2) % 3] * b / kN;
            sampled = std::min(sampled, point_to_hull(state.pose() * p - kStart));
          }
        }
      }
    }
    EXPECT_NEAR(clearance_m(world, referee), sampled, 1e-3);
  }
}

TEST(RefereeTest, ABallThatPassesHasItsClearanceAndTime) {
  World world(test_spec({{"ball", 0.2}}));
  world.reset(kStart, 0, Vector3d::Zero());
  Referee referee(world);
  EXPECT_EQ(referee.verdict().nearest_object, -1);
  // Passes 0.5 m to the left of the centre along -x, at the vehicle's height at x = 0 after 0.25 s.
  Throw toss;
  toss.object.size_m = 0.2;
  toss.speed_mps = 8;
  toss.distance_m = 2;
  toss.aim_offset_m = Eigen::Vector2d(-0.5, 0);  // right for who looks along +x
  toss.launch_height_m = kStart.z();
  world.launch(0, solve_throw(toss, world.object(0), kStart, 0));
  fly(world, referee, 2000);
  const Approach& approach = referee.verdict().objects[0];
  EXPECT_FALSE(approach.hit);
  EXPECT_NEAR(approach.clearance_m, 0.5 - 0.17 - 0.1, 2e-3);
  EXPECT_NEAR(static_cast<double>(*approach.closest_us), 0.25e6, 25e3);
  EXPECT_EQ(referee.verdict().nearest_object, 0);
  EXPECT_EQ(referee.verdict().nearest.clearance_m, approach.clearance_m);
  EXPECT_FALSE(referee.verdict().crashed);
}

TEST(RefereeTest, ADirectHitIsSeenAtTheTickOfContact) {
  World world(test_spec({{"ball", 0.2}}));
  world.reset(kStart, 0, Vector3d::Zero());
  Referee referee(world);
  Throw toss;
  toss.speed_mps = 8;
  toss.distance_m = 2;
  toss.launch_height_m = kStart.z();
  world.launch(0, solve_throw(toss, world.object(0), kStart, 0));
  int ticks = 0;
  while (!referee.verdict().nearest.hit && ticks++ < 2000) fly(world, referee, 1);
  const Approach& hit = referee.verdict().nearest;
  ASSERT_TRUE(hit.hit);
  EXPECT_EQ(hit.clearance_m, 0);
  EXPECT_EQ(hit.hit_us, world.snapshot().t_us);
  EXPECT_EQ(hit.closest_us, hit.hit_us);
  // Contact when the ball's centre is 0.17 + 0.1 m ahead, give or take a tick of 2 mm.
  EXPECT_NEAR(world.snapshot().objects[0].p_W.x(), 0.27, 2.5e-3);
  const double before_mps = world.snapshot().objects[0].v_W.x();
  fly(world, referee, 400);  // the ball bounces off
  EXPECT_EQ(referee.verdict().nearest.hit_us, hit.hit_us);
  EXPECT_GT(world.snapshot().objects[0].v_W.x(), before_mps + 2);
  EXPECT_GT((world.snapshot().vehicle.v_W).norm(), 0.1);
}

TEST(RefereeTest, ABallThatTouchesOnlyACameraHits) {
  World world(test_spec({{"ball", 0.05}}));
  world.reset(kStart, 0, Vector3d::Zero());
  Referee referee(world);
  world.launch(0, thrown(kStart + Vector3d(0.5, 0, 0.085), Vector3d(-10, 0, 0.2)));
  fly(world, referee, 400);
  EXPECT_TRUE(referee.verdict().nearest.hit);
}

TEST(RefereeTest, JudgesEachObjectAndTheNearestOfAll) {
  World world(test_spec({{"ball", 0.1}, {"ball", 0.1}, {"box", 0.1}}));
  world.reset(kStart, 0, Vector3d::Zero());
  Referee referee(world);
  world.launch(0, thrown(kStart + Vector3d(1, 0.6, 0), Vector3d(-8, 0, 0.5)));
  world.launch(1, thrown(kStart + Vector3d(1, -0.4, 0), Vector3d(-8, 0, 0.5)));
  fly(world, referee, 2000);
  const Verdict& verdict = referee.verdict();
  EXPECT_NEAR(verdict.objects[0].clearance_m, 0.6 - 0.17 - 0.05, 5e-3);
  EXPECT_NEAR(verdict.objects[1].clearance_m, 0.4 - 0.17 - 0.05, 5e-3);
  EXPECT_EQ(verdict.objects[2].clearance_m, std::numeric_limits<double>::infinity());
  EXPECT_EQ(verdict.nearest_object, 1);
}

// Against the floor in front of the vehicle, at which it hops.
TEST(RefereeTest, KnowsWhatHadTouchedTheRoomWhenItCameNearest) {
  for (const bool low : {true, false}) {
    World world(test_spec({{"ball", 0.2}}));
    Referee referee(world);
    world.reset({0, 0, 0.6}, 0, Vector3d::Zero());
    world.launch(0, thrown({2, 0.7, 0.6}, {-8, 0, low ? -3.5 : 1}));
    fly(world, referee, 1200);  // past the vehicle
    const Approach& ball = referee.verdict().objects[0];
    EXPECT_FALSE(ball.hit);
    EXPECT_GT(ball.clearance_m, 0.2);
    EXPECT_LT(ball.clearance_m, 0.7);
    EXPECT_EQ(ball.after_room, low);
    EXPECT_EQ(referee.verdict().nearest.after_room, low);
  }
}

TEST(RefereeTest, MirroredThrowsHaveTheSameClearance) {
  double clearance_m[2] = {0, 0};
  for (int side = 0; side < 2; ++side) {
    World world(test_spec({{"ball", 0.2}}));
    world.reset(kStart, 0, Vector3d::Zero());
    Referee referee(world);
    Throw toss;
    toss.bearing_deg = side ? 25 : -25;
    toss.aim_offset_m = Eigen::Vector2d(side ? 0.4 : -0.4, 0.1);
    toss.launch_height_m = kStart.z() - 0.5;
    world.launch(0, solve_throw(toss, world.object(0), kStart, 0));
    fly(world, referee, 4000);
    clearance_m[side] = referee.verdict().nearest.clearance_m;
  }
  EXPECT_GT(clearance_m[0], 0.01);
  EXPECT_NEAR(clearance_m[0], clearance_m[1], 1e-9);
}

TEST(RefereeTest, FlyingIntoTheGroundIsACrash) {
  World world(test_spec());
  world.reset(Vector3d(0, 0, 1), 0, Vector3d::Zero());
  Referee referee(world);
  int ticks = 0;
  while (!referee.verdict().crashed && ticks++ < 4000) {
    world.step({0, 0, 0, 0});
    referee.observe(world);
  }
  EXPECT_TRUE(referee.verdict().crashed);
  // The lower camera touches first, 9.25 cm below the centre.
  EXPECT_NEAR(seconds(world.snapshot().t_us), std::sqrt(2 * (1 - 0.0925) / 9.81), 5e-4);
  EXPECT_FALSE(referee.verdict().nearest.hit);
  referee.reset();
  EXPECT_FALSE(referee.verdict().crashed);
}

WorldSpec in_room(const std::string& room) {
  WorldSpec spec = test_spec({});
  spec.room = room;
  return spec;
}

// A room of which the floor, a plane, is all there is.
class OwnFloor {
 public:
  explicit OwnFloor(const std::string& attributes) {
    const std::filesystem::path models = testing::copy_models(own_.path());
    std::ofstream(models / "rooms" / "own.xml")
        << "<mujoco><worldbody><geom name='floor' type='plane' size='9 9 1' " << attributes
        << "/></worldbody></mujoco>";
    spec_.models_dir = models.string();
  }
  const WorldSpec& spec() const { return spec_; }

 private:
  testing::TemporaryDirectory own_;
  WorldSpec spec_ = in_room("own");
};

// What becomes of a vehicle that flies with this velocity in a room until it touches something;
// the left rotors push more than the right ones by roll_n each.
Verdict first_touch(const Vector3d& start, const Vector3d& v_W, bool landing, double roll_n = 0,
                    const WorldSpec& spec = in_room("room")) {
  World world(spec);
  world.reset(start, 0, v_W);
  Referee referee(world);
  for (int tick = 0; tick < 8000 && !referee.verdict().crashed && !referee.verdict().landed;
       ++tick) {
    auto thrust_n = hover(world);
    for (std::size_t left : {0U, 3U}) thrust_n[left] += roll_n;
    for (std::size_t right : {1U, 2U}) thrust_n[right] -= roll_n;
    world.step(thrust_n);
    referee.observe(world, landing);
  }
  return referee.verdict();
}

TEST(RefereeTest, AGentleTouchdownIsALandingIfItWasMeant) {
  const Verdict landed = first_touch({0, 0, 0.3}, {0.1, 0, -0.5}, true);
  EXPECT_TRUE(landed.landed);
  EXPECT_FALSE(landed.crashed);
  EXPECT_NEAR(1e-6 * static_cast<double>(landed.landed_us), (0.3 - 0.0925) / 0.5, 1e-3);
  const Verdict not_meant = first_touch({0, 0, 0.3}, {0.1, 0, -0.5}, false);
  EXPECT_TRUE(not_meant.crashed);
  EXPECT_FALSE(not_meant.landed);
}

TEST(RefereeTest, ATouchdownTooFastOrTiltedIsACrash) {
  EXPECT_TRUE(first_touch({0, 0, 0.3}, {0, 0, -0.98 * kTouchdownMps}, true).landed);
  EXPECT_TRUE(first_touch({0, 0, 0.3}, {0, 0, -1.02 * kTouchdownMps}, true).crashed);
  EXPECT_TRUE(first_touch({0, 0, 0.12}, {1.2 * kTouchdownMps, 0, -0.3}, true).crashed);
  // Rolls by 1/2 (4 x 0.1 m x roll_n / 0.0033 kg m^2) (0.4 s)^2 on its way down.
  const auto roll_n = [](double degrees) { return degrees / 57.3 * 0.0033 / (0.08 * 0.4); };
  const double tilt_deg = kTouchdownTiltDeg;
  EXPECT_TRUE(first_touch({0, 0, 0.2925}, {0, 0, -0.5}, true, roll_n(tilt_deg - 2)).landed);
  EXPECT_TRUE(first_touch({0, 0, 0.2925}, {0, 0, -0.5}, true, roll_n(tilt_deg + 2)).crashed);
}

TEST(RefereeTest, OneLandsOnASlopeUnlessItIsSteep) {
  for (const double slope_deg : {25.0, 26.5}) {
    const double slope_rad = slope_deg * M_PI / 180;
    const OwnFloor floor("zaxis='" + std::to_string(std::sin(slope_rad)) + " 0 " +
                         std::to_string(std::cos(slope_rad)) + "'");
    const Verdict verdict = first_touch({0, 0, 0.5}, {0, 0, -0.5}, true, 0, floor.spec());
    EXPECT_EQ(verdict.landed, slope_deg < 26);
    EXPECT_EQ(verdict.crashed, slope_deg > 26);
  }
}

TEST(RefereeTest, OneLandsOnTopOfThingsNotAgainstThem) {
  EXPECT_TRUE(first_touch({1.5, 3.5, 1.0}, {0, 0, -0.5}, true).landed);  // the table
  EXPECT_TRUE(first_touch({0, 3.5, 2.5}, {0, 0.5, 0}, true).crashed);    // a wall
  EXPECT_TRUE(first_touch({0, 0, 4.7}, {0, 0, 0.5}, true).crashed);      // the ceiling
}

// MuJoCo lists contacts from a margin on, and forces only from the margin less the gap.
TEST(RefereeTest, TheMarginOfARoomsGeomIsNotTouched) {
  const OwnFloor floor("margin='0.5' gap='0.5'");
  World world(floor.spec());
  world.reset(Vector3d(0, 0, 1), 0, Vector3d::Zero());
  Referee referee(world);
  for (int tick = 0; tick < 4000 && !referee.verdict().crashed; ++tick) {
    world.step({0, 0, 0, 0});
    referee.observe(world);
  }
  EXPECT_NEAR(seconds(world.snapshot().t_us), std::sqrt(2 * (1 - 0.0925) / 9.81), 5e-4);
}

TEST(RefereeTest, FlyingIntoAWallOfTheRoomIsACrash) {
  World world(in_room("room"));
  Referee referee(world);
  for (const Vector3d& direction :
       {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, -1, 0)}) {
    world.reset(Vector3d(0, 0, 2.5), 0, 9 * direction);
    referee.reset();
    fly(world, referee, 200);
    EXPECT_FALSE(referee.verdict().crashed);
    fly(world, referee, 4000);
    EXPECT_TRUE(referee.verdict().crashed);
  }
}

}  // namespace
}  // namespace dodgesim
