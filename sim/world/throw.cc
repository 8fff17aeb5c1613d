#include "sim/world/throw.h"

#include <cmath>
#include <numbers>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/gravity.h"

namespace dodgesim {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kStepS = 1e-3;          // the Runge-Kutta error of a flight stays below 1 um
constexpr double kAimToleranceM = 1e-5;  // at the aim point
constexpr int kMaxAimIterations = 50;
// Faster than hands and slingshots throw; drag coefficients hold well below the speed of sound.
constexpr double kMostLaunchSpeedMps = 100;

// Unit vector over the ground from the vehicle towards the launch point.
Eigen::Vector3d launch_direction(const Throw& toss, double heading_rad) {
  const double angle = heading_rad + kDegree * toss.bearing_deg;
  return {std::cos(angle), std::sin(angle), 0};
}

void check(const Throw& toss) {
  const bool finite = std::isfinite(toss.speed_mps) && std::isfinite(toss.distance_m) &&
                      std::isfinite(toss.bearing_deg) && toss.aim_offset_m.allFinite() &&
                      std::isfinite(toss.launch_height_m) && toss.spin_radps.allFinite();
  if (!finite || !(toss.speed_mps > 0) || !(toss.distance_m > 0) || toss.launch_us < 0) {
    throw ScenarioError(
        "A throw needs finite numbers, a positive speed_mps and distance_m and a "
        "launch time that is not negative.");
  }
}

// climb_m: from the launch to the aim point.
void check_launch_speed(const Throw& toss, double climb_m, double speed_mps) {
  if (speed_mps <= kMostLaunchSpeedMps) return;
  const char* reason = "the air slows it down; reduce throw.distance_m";
  if (toss.speed_mps < 3) reason = "so slow a throw is a lob; raise throw.speed_mps";
  if (std::abs(climb_m) > toss.distance_m) {
    reason =
        "the way up or down is longer than that; bring throw.launch_height_m nearer to the "
        "vehicle's height, or lower throw.speed_mps";
  }
  throw ScenarioError(formatted(
      "A throw over %.3g m at %.3g m/s would have to leave the hand at %.0f m/s, but %.0f is the "
      "most: %s.",
      toss.distance_m, toss.speed_mps, speed_mps, kMostLaunchSpeedMps, reason));
}

}  // namespace

TimeUs Throw::arrival_us() const { return launch_us + std::llround(1e6 * flight_s()); }

void fly(const ObjectPhysics& object, double time_s, Eigen::Vector3d& p_W, Eigen::Vector3d& v_W) {
  const Eigen::Vector3d g_W(0, 0, -kGravityMps2);
  const double drag_1pm = 0.5 * kAirDensityKgpm3 * object.drag_area_m2 / object.mass_kg;
  if (drag_1pm == 0) {
    p_W += time_s * v_W + 0.5 * time_s * time_s * g_W;
    v_W += time_s * g_W;
    return;
  }
  const auto acceleration = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return g_W - drag_1pm * v.norm() * v;
  };
  const int steps = static_cast<int>(std::ceil(time_s / kStepS));
  const double dt = time_s / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector3d a1 = acceleration(v_W);
    const Eigen::Vector3d v2 = v_W + 0.5 * dt * a1, a2 = acceleration(v2);
    const Eigen::Vector3d v3 = v_W + 0.5 * dt * a2, a3 = acceleration(v3);
    const Eigen::Vector3d v4 = v_W + dt * a3, a4 = acceleration(v4);
    p_W += dt / 6 * (v_W + 2 * v2 + 2 * v3 + v4);
    v_W += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
}

Eigen::Vector3d aim_point(const Throw& toss, const Eigen::Vector3d& aim_p_W, double heading_rad) {
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(launch_direction(toss, heading_rad));
  return aim_p_W + toss.aim_offset_m.x() * left + toss.aim_offset_m.y() * Eigen::Vector3d::UnitZ();
}

BodyState solve_throw(const Throw& toss, const ObjectPhysics& object,
                      const Eigen::Vector3d& aim_p_W, double heading_rad) {
  check(toss);
  const double time_s = toss.flight_s();
  const Eigen::Vector3d aim_W = aim_point(toss, aim_p_W, heading_rad);
  BodyState launch;
  launch.p_W = aim_W + toss.distance_m * launch_direction(toss, heading_rad);
  launch.p_W.z() = toss.launch_height_m;
  launch.w_W = toss.spin_radps;

  const auto miss = [&](const Eigen::Vector3d& v_W) -> Eigen::Vector3d {
    Eigen::Vector3d p = launch.p_W, v = v_W;
    fly(object, time_s, p, v);
    return p - aim_W;
  };
  // Shooting: Newton's method with a differenced Jacobian, from the parabola without drag.
  launch.v_W = (aim_W - launch.p_W) / time_s + Eigen::Vector3d(0, 0, 0.5 * kGravityMps2 * time_s);
  for (int i = 0; i < kMaxAimIterations; ++i) {
    const Eigen::Vector3d error = miss(launch.v_W);
    if (!error.allFinite()) break;
    if (error.norm() < kAimToleranceM) {
      check_launch_speed(toss, aim_W.z() - launch.p_W.z(), launch.v_W.norm());
      return launch;
    }
    const double h = 1e-4 * launch.v_W.norm();
    Eigen::Matrix3d J;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d dv = h * Eigen::Vector3d::Unit(k);
      J.col(k) = (miss(launch.v_W + dv) - miss(launch.v_W - dv)) / (2 * h);
    }
    launch.v_W -= J.inverse() * error;
  }
  throw ScenarioError(
      formatted("A throw over %g m at %g m/s is impossible, as the air drag of the object is too "
                "strong: raise "
                "throw.speed_mps, reduce throw.distance_m or take a heavier object.",
                toss.distance_m, toss.speed_mps));
}

}  // namespace dodgesim
