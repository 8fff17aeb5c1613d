// A fingerprint of event streams.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "sim/events/event.h"

struct XXH64_state_s;

namespace dodgesim {

// 64-bit xxHash of all events added so far. Depends on the events only, not on how they were split
// into calls: a replayed throw must give the same value.
class EventHash {
 public:
  EventHash();

  void add(std::span<const Event> events);
  std::uint64_t value() const;

 private:
  struct Free {
    void operator()(XXH64_state_s* state) const;
  };
  std::unique_ptr<XXH64_state_s, Free> state_;
};

}  // namespace dodgesim
