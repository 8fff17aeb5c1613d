// The contrast thresholds of an event camera's pixels, which differ from pixel to pixel.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "sim/base/random.h"
#include "sim/events/spec.h"

namespace dodgesim {

// Changes of the signal that make an ON and an OFF event, both positive.
struct Thresholds {
  static constexpr double kDead = std::numeric_limits<double>::infinity();  // both, of a dead pixel

  double on = 0;
  double off = 0;

  bool dead() const { return on == kDead; }
};

// Of pixels 0 .. pixel_count - 1 of the device that the stream names.
std::vector<Thresholds> draw_thresholds(const EventCameraSpec& spec, std::size_t pixel_count,
                                        const RandomStream& device);

// The means of 1/on and 1/off over the pixels that are not dead; 0 without such.
struct MeanInverse {
  double on = 0, off = 0;
};
MeanInverse mean_inverse(std::span<const Thresholds> thresholds);

}  // namespace dodgesim
