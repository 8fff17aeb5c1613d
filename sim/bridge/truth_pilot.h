// Pilots that need no perception. `oracle` knows the true state of every object in its range at the
// last tick of which an event could tell when its cycle begins: with the default delays 1.25 ms
// before, as an event takes 1.1 ms. It forgets those that have passed it. `none` sees nothing
// and only flies to the goal. Both use the flight core's avoidance and fly through the same delays,
// controller and motors as the paper's pilot.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "dodge/avoid/avoider.h"
#include "dodge/pilot.h"
#include "sim/bridge/delay_spec.h"
#include "sim/bridge/oracle_spec.h"
#include "sim/camera/camera.h"
#include "sim/sensors/readings.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

class TruthPilot : public dodge::Pilot {
 public:
  struct Setup {
    OracleSpec oracle;
    bool blind = false;                                      // the pilot `none`
    DelaySpec delays;                                        // of the packets
    TimeUs latency_us = 0;                                   // from light to an event
    double lifetime_s = 1;                                   // of an object after it was last seen
    std::vector<double> sizes_m;                             // diameters of the objects
    Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();  // the reference camera
    Intrinsics intrinsics;
  };

  TruthPilot(Setup setup, const dodge::Avoider& avoider);

  // The true state at each tick, and how the frame of the state estimates has drifted: the pilot is
  // told of objects in that frame, in which it flies and would see them.
  void observe(const Snapshot& truth, const FrameDrift& drift);

  void add_events(int, std::span<const dodge::Event>) override {}
  void add_imu(const dodge::ImuSample&) override {}
  void add_state(const dodge::StateEstimate& state) override { state_ = state; }
  void set_goal(const dodge::Goal& goal) override { goal_ = goal; }
  dodge::VelocityCommand update(TimeUs now_us) override;
  std::span<const dodge::Detection> detections() const override { return {}; }
  std::span<const dodge::Obstacle> obstacles() const override { return seen_; }

 private:
  struct Light {
    Snapshot truth;
    FrameDrift drift;
  };

  bool sees(const Snapshot& truth, std::size_t object) const;
  void see(const Light& light);

  Setup setup_;
  dodge::Avoider avoider_;
  std::deque<Light> light_;  // on its way
  std::optional<dodge::StateEstimate> state_;
  dodge::Goal goal_;
  std::vector<dodge::TrackedObstacle> obstacles_;
  std::vector<dodge::Obstacle> seen_;
};

}  // namespace dodgesim
