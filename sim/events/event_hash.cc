#include "sim/events/event_hash.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <new>

namespace dodgesim {

namespace {

constexpr std::size_t kEventBytes = 13;
constexpr std::size_t kBlock = 256;  // events that are hashed at once

void put(std::uint64_t value, std::size_t size, unsigned char*& to) {
  for (std::size_t i = 0; i < size; ++i) *to++ = static_cast<unsigned char>(value >> (8 * i));
}

// The event as bytes, little-endian, without padding.
void pack(const Event& event, unsigned char*& to) {
  put(static_cast<std::uint64_t>(event.t_us), 8, to);
  put(event.x, 2, to);
  put(event.y, 2, to);
  put(static_cast<std::uint8_t>(event.polarity), 1, to);
}

}  // namespace

void EventHash::Free::operator()(XXH64_state_s* state) const { XXH64_freeState(state); }

EventHash::EventHash() : state_(XXH64_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH64_reset(state_.get(), 0);
}

void EventHash::add(std::span<const Event> events) {
  std::array<unsigned char, kBlock * kEventBytes> bytes;
  while (!events.empty()) {
    const auto block = events.first(std::min(kBlock, events.size()));
    unsigned char* end = bytes.data();
    for (const Event& event : block) pack(event, end);
    XXH64_update(state_.get(), bytes.data(), block.size() * kEventBytes);
    events = events.subspan(block.size());
  }
}

std::uint64_t EventHash::value() const { return XXH64_digest(state_.get()); }

}  // namespace dodgesim
