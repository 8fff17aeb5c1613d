#include "dodge/detect/event_window.h"

#include <limits>

namespace dodge {

namespace {
constexpr std::size_t kInitialEvents = 1 << 15;  // a busy window of 20 ms holds about 20000
}

EventWindow::EventWindow() : events_(kInitialEvents) { arrived_.reserve(kInitialEvents); }

void EventWindow::take(TimeUs latest_us) {
  if (last_taken_us_ && *last_taken_us_ > latest_us) {
    events_.pop_front(events_.size());
    last_taken_us_.reset();
  }
  TimeUs earliest_us = empty() ? std::numeric_limits<TimeUs>::min() : newest_us();
  for (const Event& event : arrived_) {
    if (event.t_us < earliest_us || event.t_us > latest_us) {
      ++dropped_;
      continue;
    }
    earliest_us = event.t_us;
    events_.push_back(event);
  }
  arrived_.clear();
  if (!empty()) last_taken_us_ = newest_us();
}

void EventWindow::forget_until(TimeUs t_us) {
  std::size_t count = 0;
  while (count < events_.size() && events_[count].t_us <= t_us) ++count;
  events_.pop_front(count);
}

std::array<std::span<const Event>, 2> EventWindow::until(TimeUs t_us) const {
  std::size_t count = events_.size();
  while (count > 0 && events_[count - 1].t_us > t_us) --count;
  return events_.first(count);
}

}  // namespace dodge
