// A queue in one block of memory: elements enter at the back and leave at the front. Grows by
// doubling when full, so that a steady stream allocates nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace dodge {

template <class T>
class RingBuffer {
 public:
  // Room for at least `capacity` elements; rounded up to a power of two.
  explicit RingBuffer(std::size_t capacity) {
    std::size_t rounded = 1;
    while (rounded < capacity) rounded *= 2;
    slots_.resize(rounded);
  }

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return slots_.size(); }
  bool empty() const { return size_ == 0; }

  // Element i, counted from the front. Requires i < size().
  const T& operator[](std::size_t i) const { return slots_[(front_ + i) & (slots_.size() - 1)]; }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }

  void push_back(const T& value) {
    if (size_ == slots_.size()) grow();
    slots_[(front_ + size_) & (slots_.size() - 1)] = value;
    ++size_;
  }

  void pop_front(std::size_t count = 1) {
    front_ = (front_ + count) & (slots_.size() - 1);
    size_ -= count;
  }

  // The first `count` elements in order, as the two contiguous pieces they occupy.
  std::array<std::span<const T>, 2> first(std::size_t count) const {
    const std::size_t straight = std::min(count, slots_.size() - front_);
    return {std::span<const T>(slots_.data() + front_, straight),
            std::span<const T>(slots_.data(), count - straight)};
  }

 private:
  void grow() {
    std::vector<T> larger(2 * slots_.size());
    for (std::size_t i = 0; i < size_; ++i) larger[i] = (*this)[i];
    slots_.swap(larger);
    front_ = 0;
  }

  std::vector<T> slots_;
  std::size_t front_ = 0;
  std::size_t size_ = 0;
};

}  // namespace dodge
