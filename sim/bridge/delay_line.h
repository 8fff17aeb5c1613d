// A first-in first-out channel with a delay: what is pushed comes out once its arrival time has
// come.
#pragma once

#include <algorithm>
#include <deque>
#include <utility>

#include "sim/base/time.h"

namespace dodgesim {

template <class T>
class DelayLine {
 public:
  explicit DelayLine(TimeUs delay_us) : delay_us_(delay_us) {}

  // Nothing overtakes: an item sent later never arrives before one sent earlier.
  void push(TimeUs sent_us, T item) {
    TimeUs arrival_us = sent_us + delay_us_;
    if (!queue_.empty()) arrival_us = std::max(arrival_us, queue_.back().first);
    queue_.emplace_back(arrival_us, std::move(item));
  }

  // Hands every item that has arrived by now_us to `receive`, oldest first.
  template <class Receive>
  void deliver(TimeUs now_us, Receive receive) {
    while (!queue_.empty() && queue_.front().first <= now_us) {
      receive(queue_.front().second);
      queue_.pop_front();
    }
  }

 private:
  TimeUs delay_us_;
  std::deque<std::pair<TimeUs, T>> queue_;
};

}  // namespace dodgesim
