#include "sim/check/prescribed_throw.h"

#include "sim/base/random.h"

namespace dodgesim {

namespace {

constexpr double kFastTurnRps = 5, kSlowTurnRps = 2;
constexpr double kMostVehicleMps = 3;
constexpr double kSizesM[] = {0.1, 0.2, 0.3};
constexpr double kSpinRps = 10;

Eigen::Vector3d random_direction(RandomStream& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

BodyState moved(const BodyState& start, TimeUs t_us) {
  BodyState state = start;
  state.p_W += seconds(t_us) * start.v_W;
  const double angle = seconds(t_us) * start.w_W.norm();
  if (angle > 0) {
    state.q_W = Eigen::AngleAxisd(angle, start.w_W.normalized()) * start.q_W;
  }
  return state;
}

// In the camera's frame: place and velocity of an object that is in view and comes nearer, or that
// is beside the view and crosses it.
void place_object(RandomStream& random, bool from_the_side, Eigen::Vector3d& p_C,
                  Eigen::Vector3d& v_C) {
  const double depth = random.uniform(1.2, 3);
  const double speed = random.uniform(4, 8);
  if (from_the_side) {
    const double side = random.uniform() < 0.5 ? -1 : 1;
    // The view ends at 0.84 of the depth to the side.
    p_C = {side * 0.9 * depth, random.uniform(-0.3, 0.3) * depth, depth};
    v_C = {-side * speed, random.uniform(-1, 1), random.uniform(-1, 0.5)};
  } else {
    p_C = {random.uniform(-0.5, 0.5) * depth, random.uniform(-0.4, 0.4) * depth, depth};
    v_C = {random.uniform(-2, 2), random.uniform(-2, 2), -speed};
  }
}

}  // namespace

PrescribedThrow PrescribedThrow::random(std::uint64_t seed, int number,
                                        const Eigen::Isometry3d& X_BC) {
  RandomStream random(seed, static_cast<std::uint64_t>(number), "check/throw");
  PrescribedThrow toss;
  toss.size_m = kSizesM[static_cast<std::size_t>(random.uniform(0, 3))];
  toss.yaw_rad = random.uniform(-0.5, 0.5);
  BodyState& vehicle = toss.vehicle;
  vehicle.p_W = {-2 + random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                 2 + random.uniform(-0.3, 0.3)};
  vehicle.q_W = Eigen::AngleAxisd(toss.yaw_rad, Eigen::Vector3d::UnitZ());
  vehicle.v_W = random.uniform(0, kMostVehicleMps) * random_direction(random);
  const double turn = number % 2 == 0 ? kFastTurnRps : random.uniform(0, kSlowTurnRps);
  vehicle.w_W = turn * random_direction(random);
  Eigen::Vector3d p_C, v_C;
  place_object(random, number % 4 < 2, p_C, v_C);
  const Eigen::Isometry3d X_WC = vehicle.pose() * X_BC;
  toss.object.p_W = X_WC * p_C;
  toss.object.v_W = X_WC.linear() * v_C;
  toss.object.w_W = kSpinRps * random_direction(random);
  return toss;
}

Snapshot PrescribedThrow::at(TimeUs t_us) const {
  Snapshot snapshot;
  snapshot.t_us = t_us;
  snapshot.vehicle = moved(vehicle, t_us);
  snapshot.objects = {moved(object, t_us)};
  snapshot.launched = {true};
  return snapshot;
}

}  // namespace dodgesim
