// The events of a camera, in the order of their file, without strays.
//
// A stray is an event whose stamp was damaged and lies ahead of those around it: it is more than
// kSortedUs ahead of all before it, and most of the next kAhead events lie between the two. Whoever
// waits for its time would hold up all that stand behind it. So is one of the last kAhead events
// that is more than kLongestGapUs ahead of all before it. A clock that is put back or on makes no
// strays.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sim/recordings/event_reader.h"

namespace dodgesim {

class EventQueue {
 public:
  static constexpr TimeUs kSortedUs = 10000;  // events may stand that much too late in their file
  static constexpr std::size_t kAhead = 32;   // enough for a burst of 16
  static constexpr TimeUs kLongestGapUs = 600'000'000;  // a longer one is a clock that jumps

  explicit EventQueue(std::unique_ptr<EventReader> reader) : reader_(std::move(reader)) { look(); }

  // The next event; null at the end. All functions throw as EventReader does.
  const Event* front() const { return at_ < read_.size() ? &read_[at_] : nullptr; }
  void pop();  // Requires front().

  std::int64_t strays() const { return strays_; }  // passed over so far
  double part_taken() const;                       // how much of the file, 0 to 1

 private:
  void look();
  void read_on();
  bool is_stray() const;

  std::unique_ptr<EventReader> reader_;
  std::vector<Event> read_;
  std::size_t at_ = 0;      // events at the front that have been taken
  bool ended_ = false;      // all of the file has been read
  std::int64_t taken_ = 0;  // with strays
  std::int64_t strays_ = 0;
  std::optional<TimeUs> newest_us_;  // of those taken
};

}  // namespace dodgesim
