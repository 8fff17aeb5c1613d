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
  void add(const StateEstimate& state);  // in ascending time; one that is not finite is left out

  // The state at t_us: interpolated between two estimates, or carried on from the newest (oldest)
  // one at constant velocity and angular velocity. Empty as long as there is no estimate.
  std::optional<StateEstimate> at(TimeUs t_us) const;

 private:
  RingBuffer<StateEstimate> states_;
};

}  // namespace dodge
