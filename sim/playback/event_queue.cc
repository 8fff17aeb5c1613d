#include "sim/playback/event_queue.h"

#include <algorithm>
#include <limits>

namespace dodgesim {

void EventQueue::pop() {
  newest_us_ = std::max(newest_us_.value_or(read_[at_].t_us), read_[at_].t_us);
  ++at_;
  ++taken_;
  look();
}

double EventQueue::part_taken() const {
  const auto read = static_cast<double>(read_.size() - at_) + static_cast<double>(taken_);
  return read == 0 ? 1 : reader_->part_read() * static_cast<double>(taken_) / read;
}

// Sees to it that the front is no stray.
void EventQueue::look() {
  for (;;) {
    if (read_.size() - at_ <= kAhead) read_on();
    if (at_ == read_.size() || !is_stray()) return;
    ++at_;
    ++taken_;
    ++strays_;
  }
}

void EventQueue::read_on() {
  while (!ended_ && read_.size() - at_ <= kAhead) {
    const std::span<const Event> portion = reader_->next();
    ended_ = portion.empty();
    read_.erase(read_.begin(), read_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ = 0;
    read_.insert(read_.end(), portion.begin(), portion.end());
  }
}

bool EventQueue::is_stray() const {
  const TimeUs t_us = read_[at_].t_us;
  if (newest_us_ && t_us <= *newest_us_ + kSortedUs) return false;
  const TimeUs first_us = newest_us_ ? *newest_us_ - kSortedUs : std::numeric_limits<TimeUs>::min();
  const bool last = ended_ && read_.size() - at_ <= kAhead;
  if (last && newest_us_ && t_us > *newest_us_ + kLongestGapUs) return true;
  const auto begin = read_.begin() + static_cast<std::ptrdiff_t>(at_) + 1;
  const auto end = begin + std::min<std::ptrdiff_t>(kAhead, read_.end() - begin);
  const auto between = std::count_if(begin, end, [&](const Event& event) {
    return event.t_us >= first_us && event.t_us < t_us - kSortedUs;
  });
  return 2 * between > end - begin;
}

}  // namespace dodgesim
