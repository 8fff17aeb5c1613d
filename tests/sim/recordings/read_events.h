// Reading a whole recording at once.
#pragma once

#include <filesystem>

#include "sim/recordings/event_reader.h"
#include "tests/sim/recordings/random_events.h"

namespace dodgesim::testing {

inline constexpr ImageSize kImage = {640, 480};

inline Events read_events(const std::filesystem::path& path, const ImageSize& image = kImage) {
  const auto reader = open_events(path.string(), image);
  Events events;
  for (auto portion = reader->next(); !portion.empty(); portion = reader->next()) {
    events.insert(events.end(), portion.begin(), portion.end());
  }
  return events;
}

// Within that image.
inline Events random_recording(std::size_t count, std::uint64_t seed) {
  Events events = random_events(count, seed);
  for (Event& event : events) {
    event.x = static_cast<std::uint16_t>(event.x % kImage.width);
    event.y = static_cast<std::uint16_t>(event.y % kImage.height);
  }
  return events;
}

}  // namespace dodgesim::testing
