// The events of a small camera that looks at a constant scene.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tests/sim/events/reference.h"

namespace dodgesim::testing {

inline constexpr int kFieldWidth = 64;
inline constexpr int kFieldHeight = 48;
inline constexpr double kFieldPixels = kFieldWidth * kFieldHeight;

inline std::vector<Event> dark_events(const EventCameraSpec& spec, const std::vector<TimeUs>& times,
                                      std::uint64_t seed = 1, std::uint64_t throw_index = 0,
                                      std::string_view name = "top") {
  EventCamera camera(spec, kFieldWidth, kFieldHeight, seed, throw_index, name);
  return emulate(camera,
                 film(kFieldWidth, kFieldHeight, times, [](int, int, TimeUs) { return 0.2; }));
}

}  // namespace dodgesim::testing
