// The events of one camera in a sliding window of time, fed packet by packet.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "dodge/ring_buffer.h"
#include "dodge/types.h"

namespace dodge {

struct WindowConfig {
  std::int64_t window_us = 10000;
  std::int64_t event_timeout_us = 10000;
  std::int64_t camera_lag_us = 2000;

  template <class Visitor>
  void visit(Visitor& v) {
    v("window_us", window_us, 1000, 100000,
      "Length of the sliding event window; the paper uses 10 ms, longer windows see farther and "
      "slower objects at the cost of latency and work.");
    v("event_timeout_us", event_timeout_us, 0, 1000000,
      "The window ends at most this long before now, so that old events are not seen again and "
      "again when the scene falls silent.");
    v("camera_lag_us", camera_lag_us, 0, 100000,
      "The window ends where the events of both cameras have arrived, but at most this long before "
      "the newest event of any: one whose packets come later shows an object where it was, which "
      "errs in depth, and one that is silent holds up the other no longer than this.");
  }
};

class EventWindow {
 public:
  EventWindow();

  // Events as they arrive; they wait for take(). Allocates only while the largest number of events
  // so far is exceeded.
  void add(std::span<const Event> events) {
    arrived_.insert(arrived_.end(), events.begin(), events.end());
  }

  // Takes the events that have arrived into the window, in ascending time: one that is older than
  // one that the window still holds or that arrived before it, or later than latest_us, is dropped.
  // A wrong time stamp costs its own event or, if it lies ahead but not beyond latest_us, the
  // events up to it. When events of the window are later than latest_us, because the clock was set
  // back, it begins anew.
  void take(TimeUs latest_us);

  // Forgets all events of the window up to and including t_us.
  void forget_until(TimeUs t_us);

  // The window's events with t <= t_us, oldest first, in two pieces.
  std::array<std::span<const Event>, 2> until(TimeUs t_us) const;

  bool empty() const { return events_.empty(); }
  TimeUs newest_us() const { return events_.back().t_us; }  // requires !empty()

  // Since the start.
  std::optional<TimeUs> last_taken_us() const { return last_taken_us_; }  // forgotten or not
  std::int64_t dropped() const { return dropped_; }

 private:
  std::vector<Event> arrived_;  // since the last take()
  RingBuffer<Event> events_;
  std::optional<TimeUs> last_taken_us_;
  std::int64_t dropped_ = 0;
};

}  // namespace dodge
