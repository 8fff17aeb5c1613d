#include "sim/bridge/truth_pilot.h"

#include <algorithm>
#include <cmath>

#include "sim/base/gravity.h"

namespace dodgesim {

namespace {

// Whether an object that falls freely will, after any time t, be no nearer than it is now. With the
// offset o and the velocity v, both relative, |o + v t - g t^2 / 2|^2 - |o|^2 is t times a cubic,
// the least value of which must not be negative.
bool comes_no_nearer(const Eigen::Vector3d& o, const Eigen::Vector3d& v) {
  constexpr double kG = kGravityMps2;
  const double a = 2 * o.dot(v), b = v.squaredNorm() - kG * o.z(), c = -kG * v.z(), d = kG * kG / 4;
  const double root = c * c - 3 * b * d;
  const double t = root > 0 ? std::max(0.0, (std::sqrt(root) - c) / (3 * d)) : 0;
  return a >= 0 && a + b * t + c * t * t + d * t * t * t >= 0;
}

// A field that goes on pushing at what has passed drives the vehicle into a wall. What flies ahead
// of a vehicle that is faster, or rises before it falls, has not passed.
bool has_passed(const BodyState& object, const BodyState& vehicle) {
  const Eigen::Vector3d offset_W = object.p_W - vehicle.p_W;
  return offset_W.dot(object.v_W) > 0 && comes_no_nearer(offset_W, object.v_W - vehicle.v_W);
}

}  // namespace

TruthPilot::TruthPilot(Setup setup, const dodge::Avoider& avoider)
    : setup_(std::move(setup)), avoider_(avoider) {}

void TruthPilot::observe(const Snapshot& truth, const FrameDrift& drift) {
  if (!setup_.blind) light_.push_back({truth, drift});
}

bool TruthPilot::sees(const Snapshot& truth, std::size_t object) const {
  if (!truth.launched[object]) return false;
  const Eigen::Isometry3d X_CW = (truth.vehicle.pose() * setup_.X_BC).inverse();
  const Eigen::Vector3d p_C = X_CW * truth.objects[object].p_W;
  const OracleSpec& oracle = setup_.oracle;
  if (oracle.range_cap_m > 0 && p_C.norm() > oracle.range_cap_m) return false;
  if (!oracle.field_of_view) return true;
  return p_C.z() > 0 && setup_.intrinsics.contains(setup_.intrinsics.project(p_C));
}

void TruthPilot::see(const Light& light) {
  const auto& [truth, drift] = light;
  for (std::size_t i = 0; i < truth.objects.size(); ++i) {
    const int id = static_cast<int>(i);
    if (!sees(truth, i)) continue;
    if (has_passed(truth.objects[i], truth.vehicle)) {
      std::erase_if(obstacles_, [&](const auto& o) { return o.obstacle.id == id; });
      continue;
    }
    const auto known = dodge::known_obstacle(id, truth.t_us, truth.objects[i].p_W + drift.p_W,
                                             truth.objects[i].v_W + drift.v_W, setup_.sizes_m[i]);
    const auto old =
        std::ranges::find_if(obstacles_, [&](const auto& o) { return o.obstacle.id == id; });
    if (old == obstacles_.end()) {
      obstacles_.push_back(known);
    } else {
      *old = known;
    }
  }
}

dodge::VelocityCommand TruthPilot::update(TimeUs now_us) {
  const TimeUs newest_us = setup_.delays.newest_packet_end_us(now_us) - setup_.latency_us;
  for (; !light_.empty() && light_.front().truth.t_us <= newest_us; light_.pop_front()) {
    see(light_.front());
  }
  std::erase_if(obstacles_, [&](const auto& o) {
    return seconds(now_us - o.obstacle.last_detection_us) > setup_.lifetime_s;
  });
  seen_.clear();
  for (const auto& o : obstacles_) seen_.push_back(o.obstacle);
  if (!state_) return {};
  return avoider_.command(now_us, *state_, goal_, obstacles_);
}

}  // namespace dodgesim
