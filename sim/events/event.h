// One brightness change, as the event camera puts it out.
#pragma once

#include <cstdint>

#include "sim/base/time.h"

namespace dodgesim {

// Streams of a camera are ordered by (t_us, y, x, polarity).
struct Event {
  TimeUs t_us = 0;
  std::uint16_t x = 0;       // column [px]
  std::uint16_t y = 0;       // row [px]
  std::int8_t polarity = 0;  // +1 brighter, -1 darker

  bool operator==(const Event&) const = default;
};

}  // namespace dodgesim
