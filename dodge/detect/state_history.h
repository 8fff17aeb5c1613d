// The state estimates of the recent past, half a second at up to 4 kHz, and the state at any
// instant near them.
#pragma once

#include <optional>

#include "dodge/detect/ring_buffer.h"
#include "dodge/types.h"

namespace dodge {

class StateHistory {
 public:
  StateHistory();

  // In ascending time. One that is not finite, or whose q_WB is not of unit length, is left out.
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
