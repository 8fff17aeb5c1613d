// The true state of everything that moves, at one instant. What renderer, sampler, sensors and
// referee read.
#pragma once

#include <Eigen/Dense>
#include <deque>
#include <optional>
#include <vector>

#include "sim/base/contains.h"
#include "sim/base/time.h"

namespace dodgesim {

// A rigid body: pose and velocity of its frame (origin at the centre of mass) in W.
struct BodyState {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();            // [m]
  Eigen::Quaterniond q_W = Eigen::Quaterniond::Identity();  // rotates body vectors into W
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();            // [m/s]
  Eigen::Vector3d w_W = Eigen::Vector3d::Zero();            // angular velocity in W [rad/s]

  Eigen::Isometry3d pose() const {
    Eigen::Isometry3d X_W = Eigen::Isometry3d::Identity();
    X_W.linear() = q_W.toRotationMatrix();
    X_W.translation() = p_W;
    return X_W;
  }
};

struct Snapshot {
  TimeUs t_us = 0;
  BodyState vehicle;
  Eigen::Vector3d vehicle_a_W = Eigen::Vector3d::Zero();  // acceleration of B's origin [m/s^2]
  std::vector<BodyState> objects;                         // thrown objects, by index
  std::vector<bool> launched;                             // an object is invisible before launch

  bool any_launched() const { return contains(launched, true); }
};

// The snapshots of the last while, for what is later told of an instant.
class SnapshotHistory {
 public:
  // Longer than any sensing delay that makes sense.
  static constexpr TimeUs kKeptUs = 1000000;

  // At increasing instants.
  void add(const Snapshot& now);

  // The state at t_us, which may lie between two; none before the first kept or after the last.
  std::optional<Snapshot> at(TimeUs t_us) const;

 private:
  std::deque<Snapshot> snapshots_;
};

// State at t_us between a and b (a.t_us <= t_us <= b.t_us): positions and velocities linear,
// orientations by slerp. Over one tick the error of a 10 m/s throw is below 0.1 um.
Snapshot interpolate(const Snapshot& a, const Snapshot& b, TimeUs t_us);

}  // namespace dodgesim
