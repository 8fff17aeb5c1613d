#include "dodge/detect/event_window.h"

namespace dodge {

namespace {
constexpr std::size_t kInitialEvents = 1 << 15;  // a busy window of 20 ms holds about 20000
}

EventWindow::EventWindow() : events_(kInitialEvents) {}

void EventWindow::add(std::span<const Event> events) {
  for (const Event& event : events) events_.push_back(event);
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
