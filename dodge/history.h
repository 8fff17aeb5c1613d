// What the IMU and the state estimator said in the recent past, half a second at up to 4 kHz.
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "dodge/ring_buffer.h"
#include "dodge/types.h"

namespace dodge {

// The body's angular rates.
class RateHistory {
 public:
  RateHistory();

  // In ascending time; one that is far older than the last begins a history of its own. A rate
  // that is not finite is left out.
  void add(const ImuSample& sample);

  // Time-weighted mean of w_WB_B over [begin_us, end_us] [rad/s], linear between samples and
  // constant outside of them. Zero as long as there is no sample. Requires begin_us <= end_us.
  Eigen::Vector3d mean(TimeUs begin_us, TimeUs end_us) const;

  // Of the newest sample that was not left out.
  std::optional<TimeUs> newest_us() const;

 private:
  Eigen::Vector3d at(TimeUs t_us) const;

  RingBuffer<ImuSample> samples_;
};

// The state estimates, and the state at any instant near them.
class StateHistory {
 public:
  StateHistory();

  // In ascending time, likewise. One that is not finite, or whose q_WB is not of unit length, is
  // left out.
  void add(const StateEstimate& state);

  // The state at t_us: interpolated between two estimates, or carried on from the newest (oldest)
  // one at constant velocity and angular velocity, however old that is. Empty as long as there is
  // no estimate.
  std::optional<StateEstimate> at(TimeUs t_us) const;

  // Of the newest estimate that was not left out.
  std::optional<TimeUs> newest_us() const;

 private:
  RingBuffer<StateEstimate> states_;
};

}  // namespace dodge
