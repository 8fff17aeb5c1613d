// Recordings for tests of what writes and reads them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

#include "sim/base/random.h"
#include "sim/recordings/event_writer.h"

namespace dodgesim::testing {

using Events = std::vector<Event>;

// In order of time, several of them at the same instant, with gaps of several milliseconds.
inline Events random_events(std::size_t count, std::uint64_t seed, TimeUs longest_gap_us = 40) {
  RandomStream random(seed, 0, "events");
  Events events;
  TimeUs t_us = static_cast<TimeUs>(random.uniform(0, 3000));
  for (std::size_t i = 0; i < count; ++i) {
    const double gap = random.uniform() < 0.001 ? 5000 : static_cast<double>(longest_gap_us);
    t_us += static_cast<TimeUs>(random.uniform(0, gap));
    events.push_back({t_us, static_cast<std::uint16_t>(random.next_u32()),
                      static_cast<std::uint16_t>(random.next_u32()),
                      static_cast<std::int8_t>(random.uniform() < 0.5 ? 1 : -1)});
  }
  return events;
}

// Writes in portions of random size, as a camera does.
inline void write(const std::filesystem::path& path, const Recording& recording,
                  const Events& events) {
  RandomStream random(99, 0, "portions");
  const auto writer = make_event_writer(path, recording);
  for (std::size_t i = 0; i < events.size();) {
    const auto n = std::min(events.size() - i, static_cast<std::size_t>(random.uniform(0, 3000)));
    writer->add({events.data() + i, n});
    i += n;
  }
  writer->commit();
}

inline Recording recording_of(const Events& events, TimeUs t_offset_us = 0) {
  return {640, 480, t_offset_us, events.empty() ? 0 : events.back().t_us};
}

}  // namespace dodgesim::testing
