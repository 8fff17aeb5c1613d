// Events as 64-bit words whose order as integers is the order (t, y, x, polarity) of a stream.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/time.h"
#include "sim/events/cause.h"
#include "sim/events/event.h"

namespace dodgesim {

class EventWords {
 public:
  static constexpr int kMaxSide = 4096;                        // of an image [px]
  static constexpr TimeUs kMaxTimeUs = (TimeUs{1} << 31) - 1;  // since the origin

  // Column and row of a pixel, to be kept at hand.
  static constexpr std::uint64_t address(std::uint64_t x, std::uint64_t y) {
    return y << kRowShift | x << kColumnShift;
  }

  // `since_us` counts from an origin that the user of this class keeps; 0 to kMaxTimeUs.
  void push(TimeUs since_us, std::uint64_t address, bool on, Cause cause) {
    words_.push_back(static_cast<std::uint64_t>(since_us) << kTimeShift | address |
                     static_cast<std::uint64_t>(on) << kPolarityShift | cause);
  }
  // The same with all but the time taken from another word; see rest().
  void push(TimeUs since_us, std::uint64_t rest) {
    words_.push_back(static_cast<std::uint64_t>(since_us) << kTimeShift | rest);
  }
  static constexpr int kRestBits = 25;  // of what without_cause() leaves
  static std::uint64_t without_cause(std::uint64_t rest) { return rest >> kPolarityShift; }
  void clear() { words_.clear(); }
  void sort();
  void sort_ties();  // of words that are in order of time

  std::size_t size() const { return words_.size(); }
  TimeUs since_us(std::size_t i) const { return static_cast<TimeUs>(words_[i] >> kTimeShift); }
  std::uint64_t rest(std::size_t i) const { return words_[i] & ((1ull << kTimeShift) - 1); }
  Cause cause(std::size_t i) const { return static_cast<Cause>(words_[i]); }
  Event event(std::size_t i, TimeUs origin_us) const {
    const std::uint64_t word = words_[i];
    return {origin_us + static_cast<TimeUs>(word >> kTimeShift),
            static_cast<std::uint16_t>(word >> kColumnShift & (kMaxSide - 1)),
            static_cast<std::uint16_t>(word >> kRowShift & (kMaxSide - 1)),
            static_cast<std::int8_t>((word >> kPolarityShift & 1) != 0 ? 1 : -1)};
  }

 private:
  // Time since the origin (31 bits), y, x (12 bits each), polarity (1), cause (8).
  static constexpr int kTimeShift = 33;
  static constexpr int kRowShift = 21;
  static constexpr int kColumnShift = 9;
  static constexpr int kPolarityShift = 8;

  std::vector<std::uint64_t> words_;
  std::vector<std::uint64_t> sorted_;  // scratch
};

}  // namespace dodgesim
