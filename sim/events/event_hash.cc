#include "sim/events/event_hash.h"

#include <xxhash.h>

#include <array>
#include <new>

namespace dodgesim {

namespace {

constexpr std::size_t kEventBytes = 13;

// The event as bytes, little-endian, without padding.
std::array<unsigned char, kEventBytes> packed(const Event& event) {
  std::array<unsigned char, kEventBytes> bytes{};
  const auto put = [&bytes](std::size_t at, std::uint64_t value, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      bytes[at + i] = static_cast<unsigned char>(value >> (8 * i));
    }
  };
  put(0, static_cast<std::uint64_t>(event.t_us), 8);
  put(8, event.x, 2);
  put(10, event.y, 2);
  put(12, static_cast<std::uint8_t>(event.polarity), 1);
  return bytes;
}

}  // namespace

void EventHash::Free::operator()(XXH64_state_s* state) const { XXH64_freeState(state); }

EventHash::EventHash() : state_(XXH64_createState()) {
  if (!state_) throw std::bad_alloc();
  reset();
}

void EventHash::reset() { XXH64_reset(state_.get(), 0); }

void EventHash::add(std::span<const Event> events) {
  for (const Event& event : events) {
    const auto bytes = packed(event);
    XXH64_update(state_.get(), bytes.data(), bytes.size());
  }
}

std::uint64_t EventHash::value() const { return XXH64_digest(state_.get()); }

}  // namespace dodgesim
