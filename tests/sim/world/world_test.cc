#include "sim/world/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "sim/base/error.h"
#include "tests/nominal_vehicle.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

constexpr int kTicksPerSecond = 4000;

void run(World& world, const std::array<double, 4>& thrust_n, int ticks) {
  for (int i = 0; i < ticks; ++i) world.step(thrust_n);
}

TEST(WorldTest, ReadsTheVehicleFromItsModel) {
  const World world(test_spec({}));
  const VehicleParameters& vehicle = world.vehicle();
  const VehicleParameters nominal = nominal_vehicle();
  EXPECT_DOUBLE_EQ(vehicle.mass_kg, nominal.mass_kg);
  EXPECT_TRUE(vehicle.inertia_kgm2.isApprox(nominal.inertia_kgm2, 1e-12));
  EXPECT_DOUBLE_EQ(vehicle.kappa_m, nominal.kappa_m);
  EXPECT_DOUBLE_EQ(vehicle.max_thrust_n, nominal.max_thrust_n);
  EXPECT_TRUE(vehicle.drag_1ps.isApprox(nominal.drag_1ps));
  EXPECT_DOUBLE_EQ(vehicle.drag_kh_1pm, nominal.drag_kh_1pm);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_DOUBLE_EQ(vehicle.rotor_p_B[k].x(), nominal.rotor_p_B[k].x());
    EXPECT_DOUBLE_EQ(vehicle.rotor_p_B[k].y(), nominal.rotor_p_B[k].y());
    EXPECT_EQ(vehicle.rotor_spin[k], nominal.rotor_spin[k]);
  }
}

TEST(WorldTest, CamerasLookForwardOneAboveTheOther) {
  const World world(test_spec({}));
  const auto& X_BC = world.vehicle().X_BC;
  ASSERT_EQ(X_BC.size(), 2u);
  for (const Eigen::Isometry3d& X : X_BC) {
    EXPECT_TRUE(X.linear().col(2).isApprox(Vector3d::UnitX(), 1e-9));   // z forward
    EXPECT_TRUE(X.linear().col(1).isApprox(-Vector3d::UnitZ(), 1e-9));  // y down
    EXPECT_TRUE(X.linear().col(0).isApprox(-Vector3d::UnitY(), 1e-9));  // x right
  }
  EXPECT_TRUE((X_BC[0].translation() - X_BC[1].translation()).isApprox(Vector3d(0, 0, 0.15)));
  EXPECT_TRUE(world.vehicle().X_BR.linear().col(2).isApprox(-Vector3d::UnitZ(), 1e-9));
}

TEST(WorldTest, CamerasAgreeWithMujocosOwn) {
  World world(test_spec({}));
  world.reset(Vector3d(1, 2, 3), 0.7, Vector3d::Zero());
  mj_camlight(&world.model(), const_cast<mjData*>(&world.data()));
  const Eigen::Isometry3d X_WC = world.snapshot().vehicle.pose() * world.vehicle().X_BC[1];
  const int camera = mj_name2id(&world.model(), mjOBJ_CAMERA, "bottom");
  const double* R = world.data().cam_xmat + 9 * camera;  // row-major; looks along -z
  EXPECT_TRUE(X_WC.translation().isApprox(
      Eigen::Map<const Vector3d>(world.data().cam_xpos + 3 * camera), 1e-9));
  EXPECT_TRUE(X_WC.linear().col(2).isApprox(-Vector3d(R[2], R[5], R[8]), 1e-9));
  EXPECT_TRUE(X_WC.linear().col(1).isApprox(-Vector3d(R[1], R[4], R[7]), 1e-9));
}

TEST(WorldTest, WeightBearingThrustKeepsTheVehicleAtRest) {
  World world(test_spec({}));
  world.reset(kStart, 0.4, Vector3d::Zero());
  run(world, hover(world), kTicksPerSecond);
  EXPECT_EQ(world.snapshot().t_us, 1'000'000);
  EXPECT_LT((world.snapshot().vehicle.p_W - kStart).norm(), 1e-9);
  EXPECT_LT(world.snapshot().vehicle.w_W.norm(), 1e-9);
  EXPECT_LT(world.snapshot().vehicle_a_W.norm(), 1e-9);
}

TEST(WorldTest, AFallingVehicleFollowsTheParabola) {
  World world(test_spec({}));
  world.reset(Vector3d(0, 0, 20), 0, Vector3d::Zero());
  run(world, {0, 0, 0, 0}, kTicksPerSecond);
  EXPECT_NEAR(world.snapshot().vehicle.p_W.z(), 20 - 0.5 * kGravityMps2, 1e-6);
  EXPECT_NEAR(world.snapshot().vehicle.v_W.z(), -kGravityMps2, 1e-9);
  EXPECT_NEAR(world.snapshot().vehicle_a_W.z(), -kGravityMps2, 1e-9);
}

// Along and across the vehicle it differs, wherever the vehicle is heading.
TEST(WorldTest, RotorDragBrakesAsItsClosedForm) {
  World world(test_spec({}));
  for (const double yaw_rad : {0.0, 1.0}) {
    const Eigen::Quaterniond q_W(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ()));
    world.reset(kStart, yaw_rad, q_W * Vector3d(3, 2, 0));
    run(world, hover(world), kTicksPerSecond);
    const Vector3d v_B = q_W.conjugate() * world.snapshot().vehicle.v_W;
    EXPECT_NEAR(v_B.x(), 3 * std::exp(-0.544), 1e-5);
    EXPECT_NEAR(v_B.y(), 2 * std::exp(-0.386), 1e-5);
    // v_z = k_h times the integral of the squared horizontal speed.
    const double gained = 0.009 * (9 * (1 - std::exp(-2 * 0.544)) / (2 * 0.544) +
                                   4 * (1 - std::exp(-2 * 0.386)) / (2 * 0.386));
    EXPECT_NEAR(v_B.z(), gained, 1e-5);
  }
}

// Torques of one rotor with 0.1 N more than the others, about the axes of B.
TEST(WorldTest, EachRotorTurnsTheVehicleTheRightWay) {
  World world(test_spec({}));
  for (std::size_t k = 0; k < 4; ++k) {
    world.reset(kStart, 1.0, Vector3d::Zero());
    std::array<double, 4> thrust_n = hover(world);
    thrust_n[k] += 0.1;
    world.step(thrust_n);
    const VehicleParameters& vehicle = world.vehicle();
    const Vector3d torque(0.1 * vehicle.rotor_p_B[k].y(), -0.1 * vehicle.rotor_p_B[k].x(),
                          0.1 * 0.012 * (k % 2 ? -1 : 1));
    const Vector3d expected_w_B = 250e-6 * torque.cwiseQuotient(vehicle.inertia_kgm2);
    const BodyState& state = world.snapshot().vehicle;
    EXPECT_TRUE((state.q_W.conjugate() * state.w_W).isApprox(expected_w_B, 1e-4));
  }
}

TEST(WorldTest, ThrustIsClippedToWhatARotorCanGive) {
  World world(test_spec({}));
  world.reset(kStart, 0, Vector3d::Zero());
  world.step({100, 100, 100, 100});
  EXPECT_NEAR(world.snapshot().vehicle_a_W.z(), 4 * 9.5 - kGravityMps2, 1e-9);
  world.reset(kStart, 0, Vector3d::Zero());
  world.step({-5, -5, -5, -5});
  EXPECT_NEAR(world.snapshot().vehicle_a_W.z(), -kGravityMps2, 1e-9);
}

TEST(WorldTest, ATumblingBoxKeepsItsEnergyAndAngularMomentum) {
  World world(test_spec({{"box", 0.3}}));
  world.reset(kStart, 0, Vector3d::Zero());
  world.launch(0, thrown(Vector3d(5, 0, 9), Vector3d::Zero(), Vector3d(4, 20, 3)));
  const Eigen::Map<const Vector3d> J(world.model().body_inertia + 3 * world.object_body(0));
  const double* q = world.model().body_iquat + 4 * world.object_body(0);
  const Eigen::Quaterniond q_BI(q[0], q[1], q[2], q[3]);
  const auto momentum = [&] {
    const BodyState& state = world.snapshot().objects[0];
    const Eigen::Quaterniond q_WI = state.q_W * q_BI;
    const Vector3d L_I = J.cwiseProduct(q_WI.conjugate() * state.w_W);
    return Vector3d(q_WI * L_I);
  };
  const Vector3d before = momentum();
  const double energy_before = before.dot(world.snapshot().objects[0].w_W);
  run(world, hover(world), kTicksPerSecond);
  EXPECT_LT((momentum() - before).norm(), 1e-5 * before.norm());
  EXPECT_NEAR(momentum().dot(world.snapshot().objects[0].w_W), energy_before, 1e-6 * energy_before);
}

TEST(WorldTest, ABallKeepsItsSpin) {
  World world(test_spec());
  world.reset(kStart, 0, Vector3d::Zero());
  const Vector3d spin(5, -20, 30);
  world.launch(0, thrown(Vector3d(5, 0, 9), Vector3d(1, 2, 3), spin));
  run(world, hover(world), kTicksPerSecond);
  EXPECT_LT((world.snapshot().objects[0].w_W - spin).norm(), 1e-6);
}

TEST(WorldTest, ADraggedBallLosesEnergyOnlyToDrag) {
  World world(test_spec());
  world.reset(kStart, 0, Vector3d::Zero());
  world.launch(0, thrown(Vector3d(5, 0, 9), Vector3d(8, 2, 3)));
  const ObjectPhysics& ball = world.object(0);
  double work_j = 0;
  const auto energy = [&] {
    const BodyState& state = world.snapshot().objects[0];
    return ball.mass_kg * (0.5 * state.v_W.squaredNorm() + kGravityMps2 * state.p_W.z());
  };
  const double before_j = energy();
  for (int i = 0; i < kTicksPerSecond; ++i) {
    const double speed_before = world.snapshot().objects[0].v_W.norm();
    world.step(hover(world));
    const double speed = 0.5 * (speed_before + world.snapshot().objects[0].v_W.norm());
    work_j += 250e-6 * 0.5 * 1.2 * ball.drag_area_m2 * speed * speed * speed;
  }
  EXPECT_GT(work_j, 0.01 * before_j);
  EXPECT_NEAR(before_j - energy(), work_j, 1e-5 * work_j);
}

TEST(WorldTest, ScalesABallAsItsRulesSay) {
  const World world(test_spec({{"ball", 0.067}, {"ball", 0.24}, {"ball", 1.0}}));
  EXPECT_NEAR(world.object(0).mass_kg, 0.058, 0.02);  // a tennis ball, within the rule's scatter
  EXPECT_NEAR(world.object(1).mass_kg, 0.62, 0.1);    // a basketball
  for (int i = 0; i < 3; ++i) {
    const double d = test_spec({{"ball", 0.067}, {"ball", 0.24}, {"ball", 1.0}})
                         .objects[static_cast<std::size_t>(i)]
                         .size_m;
    EXPECT_NEAR(world.object(i).mass_kg, 9.5 * d * d, 1e-9);
    EXPECT_NEAR(world.object(i).drag_area_m2, 0.47 * M_PI / 4 * d * d, 1e-8);
    EXPECT_NEAR(world.object(i).bounding_radius_m, d / 2, 1e-12);
    const double inertia = world.model().body_inertia[3 * world.object_body(i)];
    EXPECT_NEAR(inertia, 2.0 / 3.0 * 9.5 * d * d * d * d / 4, 2e-3 * inertia);
  }
}

TEST(WorldTest, ParkedObjectsStayOutOfTheWorld) {
  World world(test_spec({{"ball", 0.2}, {"ball", 0.2}}));
  world.reset(kStart, 0, Vector3d::Zero());
  const Snapshot before = world.snapshot();
  run(world, hover(world), 400);
  EXPECT_EQ(world.data().ncon, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_FALSE(world.snapshot().launched[i]);
    EXPECT_EQ(world.snapshot().objects[i].p_W, before.objects[i].p_W);
    EXPECT_GT(before.objects[i].p_W.norm(), 500);
  }
  world.launch(1, thrown(Vector3d(5, 0, 9), Vector3d(1, 2, 3)));
  EXPECT_FALSE(world.snapshot().launched[0]);
  EXPECT_TRUE(world.snapshot().launched[1]);
  EXPECT_EQ(world.snapshot().objects[1].p_W, Vector3d(5, 0, 9));
  world.reset(kStart, 0, Vector3d::Zero());
  EXPECT_FALSE(world.snapshot().launched[1]);
  EXPECT_GT(world.snapshot().objects[1].p_W.norm(), 500);
}

TEST(WorldTest, AnObjectStartsInTheStateOfItsLaunch) {
  World world(test_spec());
  world.reset(kStart, 0, Vector3d::Zero());
  BodyState launch = thrown(Vector3d(5, 1, 9), Vector3d(1, 2, 3), Vector3d(4, 5, 6));
  launch.q_W = Eigen::AngleAxisd(0.8, Vector3d(1, 2, -1).normalized());
  world.launch(0, launch);
  const BodyState& state = world.snapshot().objects[0];
  EXPECT_EQ(state.p_W, launch.p_W);
  EXPECT_LT(state.q_W.angularDistance(launch.q_W), 1e-12);
  EXPECT_EQ(state.v_W, launch.v_W);
  EXPECT_TRUE(state.w_W.isApprox(launch.w_W, 1e-12));
}

// A constant spin turns the body about that axis, by the angle it must.
TEST(WorldTest, ASpinningBallTurnsAboutItsAxis) {
  World world(test_spec());
  world.reset(kStart, 0, Vector3d::Zero());
  BodyState launch = thrown(Vector3d(5, 1, 9), Vector3d::Zero(), Vector3d(0.4, -1.2, 0.9));
  launch.q_W = Eigen::AngleAxisd(0.8, Vector3d(1, 2, -1).normalized());
  world.launch(0, launch);
  run(world, hover(world), kTicksPerSecond);
  const Vector3d axis = launch.w_W.normalized();
  const Eigen::Quaterniond expected = Eigen::AngleAxisd(launch.w_W.norm(), axis) * launch.q_W;
  EXPECT_LT(world.snapshot().objects[0].q_W.angularDistance(expected), 1e-6);
}

TEST(WorldTest, AnObjectBouncesOffTheGround) {
  using Case = std::pair<const char*, double>;  // with the height at which it touches
  for (const auto& [kind, touching_m] :
       {Case("ball", 0.1), {"box", 0.05}, {"marker", 0.1}, {"quadrotor", 0.0131}}) {
    SCOPED_TRACE(kind);
    World world(test_spec({{kind, 0.2}}));
    world.reset(kStart, 0, Vector3d::Zero());
    world.launch(0, thrown(Vector3d(5, 0, 1), Vector3d(0, 0, -8)));
    double lowest_m = 1, down_mps = 0, up_mps = 0;
    for (int i = 0; i < kTicksPerSecond / 4; ++i) {
      world.step(hover(world));
      const BodyState& object = world.snapshot().objects[0];
      lowest_m = std::min(lowest_m, object.p_W.z());
      down_mps = std::max(down_mps, -object.v_W.z());
      up_mps = std::max(up_mps, object.v_W.z());
    }
    EXPECT_NEAR(touching_m - lowest_m, 0.0008 * down_mps, 0.0002 * down_mps);
    EXPECT_NEAR(up_mps, 0.55 * down_mps, 0.05 * down_mps);
  }
}

// Two balls that meet head-on do not pass through each other, and part as balls do.
TEST(WorldTest, ObjectsThatMeetBounce) {
  for (const double speed_mps : {2.0, 5.0, 15.0}) {
    SCOPED_TRACE(speed_mps);
    World world(test_spec({{"ball", 0.2}, {"ball", 0.2}}));
    world.reset(kStart, 0, Vector3d::Zero());
    world.launch(0, thrown(Vector3d(5, 0, 9), Vector3d(speed_mps, 0, 0)));
    world.launch(1, thrown(Vector3d(5.5, 0, 9), Vector3d(-speed_mps, 0, 0)));
    double nearest_m = 1;
    for (int i = 0; i < static_cast<int>(kTicksPerSecond * 0.4 / speed_mps); ++i) {
      world.step(hover(world));
      const auto& objects = world.snapshot().objects;
      nearest_m = std::min(nearest_m, (objects[1].p_W - objects[0].p_W).norm());
    }
    const auto& objects = world.snapshot().objects;
    EXPECT_NEAR(0.2 - nearest_m, 0.0008 * 2 * speed_mps, 0.0001 * 2 * speed_mps);
    EXPECT_NEAR(objects[0].v_W.x(), -objects[1].v_W.x(), 1e-6);
    EXPECT_NEAR(objects[1].v_W.x(), 0.55 * speed_mps, 0.05 * speed_mps);
  }
}

TEST(WorldTest, ManyObjectsMayLieOnTheGround) {
  World world(test_spec(std::vector<ObjectSpec>(16, {"quadrotor", 0.5})));
  world.reset(kStart, 0, Vector3d::Zero());
  for (int i = 0; i < 16; ++i) {
    const int row = i / 4;
    world.launch(i, thrown(Vector3d(5 + i % 4, row - 1.5, 0.2), Vector3d::Zero()));
  }
  EXPECT_NO_THROW(run(world, hover(world), kTicksPerSecond));
  // On the pod, whose underside is 0.025 m below the centre at the model's own size.
  for (const BodyState& object : world.snapshot().objects) {
    EXPECT_NEAR(object.p_W.z(), 0.025 * 0.5 / 0.3816, 1e-3);
  }
}

TEST(WorldTest, OneObjectDoesNotDisturbTheFlightOfAnother) {
  World alone(test_spec()), crowd(test_spec({{"ball", 0.2}, {"box", 0.3}, {"ball", 0.1}}));
  for (World* world : {&alone, &crowd}) {
    world->reset(kStart, 0, Vector3d::Zero());
    world->launch(0, thrown(Vector3d(5, 0, 9), Vector3d(-4, 1, 2), Vector3d(3, 4, 5)));
  }
  crowd.launch(1, thrown(Vector3d(-5, 0, 9), Vector3d(-4, 1, 2), Vector3d(3, 4, 5)));
  run(alone, hover(alone), 2000);
  run(crowd, hover(crowd), 2000);
  EXPECT_EQ(alone.snapshot().objects[0].p_W, crowd.snapshot().objects[0].p_W);
  EXPECT_EQ(alone.snapshot().vehicle.p_W, crowd.snapshot().vehicle.p_W);
}

TEST(WorldTest, TheSameInputsGiveTheSameBytes) {
  World first(test_spec()), second(test_spec());
  // The second has a past that must not show.
  second.reset(Vector3d(1, 1, 1), 2, Vector3d(1, 1, 1));
  second.launch(0, thrown(Vector3d(1, 1, 1.1), Vector3d::Zero()));
  run(second, {1, 2, 3, 4}, 300);
  for (World* world : {&first, &second}) {
    world->reset(kStart, 0.3, Vector3d(1, 0, 0));
    world->launch(0, thrown(kStart + Vector3d(1, 0, 0.05), Vector3d(-4, 0, 0), Vector3d(3, 4, 5)));
    run(*world, {2.6, 2.5, 2.4, 2.5}, 2000);  // includes a collision
  }
  EXPECT_EQ(0, std::memcmp(first.data().qpos, second.data().qpos,
                           sizeof(mjtNum) * static_cast<std::size_t>(first.model().nq)));
  EXPECT_EQ(0, std::memcmp(first.data().qvel, second.data().qvel,
                           sizeof(mjtNum) * static_cast<std::size_t>(first.model().nv)));
}

TEST(WorldTest, MujocosPositionsAreThoseOfTheSnapshot) {
  World world(test_spec());
  world.reset(kStart, 0, Vector3d(10, 0, 0));
  world.launch(0, thrown(Vector3d(5, 0, 9), Vector3d(-10, 0, 0)));
  run(world, hover(world), 100);
  const auto xpos = [&](int body) {
    return Vector3d(Eigen::Map<const Vector3d>(world.data().xpos + 3 * body));
  };
  EXPECT_EQ(xpos(world.vehicle_body()), world.snapshot().vehicle.p_W);
  EXPECT_EQ(xpos(world.object_body(0)), world.snapshot().objects[0].p_W);
}

TEST(WorldTest, AThrustThatIsNoNumberIsASimulationError) {
  World world(test_spec());
  world.reset(kStart, 0, Vector3d::Zero());
  EXPECT_THROW(world.step({1, std::numeric_limits<double>::quiet_NaN(), 1, 1}), SimulationError);
}

TEST(WorldTest, ADivergedStateIsASimulationErrorAndResetHealsIt) {
  World world(test_spec());
  world.reset(kStart, 0, Vector3d::Zero());
  world.launch(0, thrown(Vector3d(5, 0, 9), Vector3d(std::nan(""), 0, 0)));
  EXPECT_THROW(world.step(hover(world)), SimulationError);
  world.reset(kStart, 0, Vector3d::Zero());
  world.launch(0, thrown(Vector3d(5, 0, 9), Vector3d(1e8, 0, 0)));
  EXPECT_THROW(run(world, hover(world), 10), SimulationError);
  world.reset(kStart, 0, Vector3d::Zero());
  run(world, hover(world), 10);
  EXPECT_LT((world.snapshot().vehicle.p_W - kStart).norm(), 1e-9);
}

}  // namespace
}  // namespace dodgesim
