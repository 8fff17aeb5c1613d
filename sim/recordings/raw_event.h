// What stands in a file for an event, before it is known to be one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "sim/base/error.h"
#include "sim/recordings/event_reader.h"

namespace dodgesim {

constexpr std::int64_t kLastUs = std::int64_t{1} << 60;  // sums of instants do not overflow

// Among so many first events one with a fraction tells that a recording is in seconds.
constexpr std::size_t kEventsThatTellUnit = 1 << 14;

struct RawEvent {
  std::int64_t t_us = 0, x = 0, y = 0, p = 0;
};

// For EventReader::part_read().
template <class Count>
double share(Count read, Count all) {
  return all == 0 ? 1 : std::min(1.0, static_cast<double>(read) / static_cast<double>(all));
}

// The event, if its pixel lies in the image and p is -1, 0 or 1. Otherwise throws ScenarioError;
// `place` tells where the event stands: "e.csv:12", "e.npy, event 11".
template <class Place>
Event checked_event(const RawEvent& raw, const ImageSize& image, const Place& place) {
  const auto refuse = [&](const char* name, std::int64_t value, std::int64_t least,
                          std::int64_t most, const char* hint = "") {
    throw ScenarioError(place() + ": " + name + " is " + std::to_string(value) +
                        ", but must be from " + std::to_string(least) + " to " +
                        std::to_string(most) + "." + hint);
  };
  if (raw.t_us < 0) refuse("t [us]", raw.t_us, 0, kLastUs);
  // More than 30,000 years: of today's clocks only those that count nanoseconds show as much.
  if (raw.t_us > kLastUs) refuse("t [us]", raw.t_us, 0, kLastUs, " Are these nanoseconds?");
  if (raw.x < 0 || raw.x >= image.width) refuse("x", raw.x, 0, image.width - 1);
  if (raw.y < 0 || raw.y >= image.height) refuse("y", raw.y, 0, image.height - 1);
  if (raw.p < -1 || raw.p > 1) refuse("p", raw.p, -1, 1);
  return {raw.t_us, static_cast<std::uint16_t>(raw.x), static_cast<std::uint16_t>(raw.y),
          static_cast<std::int8_t>(raw.p > 0 ? 1 : -1)};
}

}  // namespace dodgesim
