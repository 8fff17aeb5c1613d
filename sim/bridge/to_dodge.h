// The simulator's readings as the flight core is handed them.
#pragma once

#include "dodge/types.h"
#include "sim/events/event.h"
#include "sim/sensors/readings.h"

namespace dodgesim {

inline dodge::Event to_dodge(const Event& event) {
  return {.t_us = event.t_us, .x = event.x, .y = event.y, .polarity = event.polarity};
}

inline dodge::ImuSample to_dodge(const ImuReading& reading) {
  return {.t_us = reading.t_us, .w_WB_B = reading.w_B_radps, .f_B = reading.f_B_mps2};
}

inline dodge::StateEstimate to_dodge(const StateReading& reading) {
  return {.t_us = reading.t_us,
          .p_WB = reading.p_W,
          .q_WB = reading.q_W,
          .v_WB = reading.v_W,
          .w_WB_B = reading.w_B};
}

inline dodge::RangeReading to_dodge(const RangeReading& reading) {
  return {.t_us = reading.t_us, .range_m = reading.range_m};
}

}  // namespace dodgesim
