// Event streams on disk, and a fingerprint of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>

#include "sim/events/event.h"

struct XXH64_state_s;

namespace dodgesim {

// 64-bit xxHash of all events added so far. Depends on the events only, not on how they were split
// into calls: a replayed throw must give the same value.
class EventHash {
 public:
  EventHash();

  void reset();
  void add(std::span<const Event> events);
  std::uint64_t value() const;

 private:
  struct Free {
    void operator()(XXH64_state_s* state) const;
  };
  std::unique_ptr<XXH64_state_s, Free> state_;
};

// Appends an event as a line: t_us x y p, with p 1 for ON and 0 for OFF, as common readers want it.
void append_line(std::string& text, const Event& event);

// Writes text, one event a line.
class EventLog {
 public:
  // Throws IoError if the file cannot be created.
  explicit EventLog(const std::filesystem::path& path);

  void add(std::span<const Event> events);

  // Throws IoError if anything was not written. Without it the file must be taken as incomplete.
  void close();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
  std::string buffer_;
};

}  // namespace dodgesim
