// The words of Prophesee's formats EVT 2.0 and EVT 3.0, whose upper four bits say what they are.
// Source: docs.prophesee.ai, "EVT 2.0 Format", "EVT 3.0 Format".
#pragma once

#include <cstdint>
#include <optional>

#include "sim/recordings/raw_event.h"

namespace dodgesim {

// The upper bits of the camera's clock, which begin again at 0 when they are used up.
class ClockHigh {
 public:
  explicit ClockHigh(int bits) : range_(std::int64_t{1} << bits) {}

  // Returns whether they are others than before.
  bool set(std::int64_t bits) {
    if (bits_ == bits) return false;
    if (bits_ && *bits_ - bits > range_ / 2) ++turns_;
    bits_ = bits;
    return true;
  }
  bool known() const { return bits_.has_value(); }
  std::int64_t value() const { return turns_ * range_ + *bits_; }  // requires known()

 private:
  std::int64_t range_;
  std::int64_t turns_ = 0;
  std::optional<std::int64_t> bits_;
};

// What a sink gets are the events, as RawEvent. There are none before the clock is known.

// Words of 32 bits: an event, or the upper bits of the clock.
class Evt2 {
 public:
  using Word = std::uint32_t;
  enum Kind : Word { kOff = 0x0, kOn = 0x1, kTimeHigh = 0x8 };

  static constexpr Word time_high(std::int64_t t_us) {
    return kTimeHigh << 28 | static_cast<Word>(t_us >> 6 & 0xfffffff);
  }
  static constexpr Word event(std::int64_t t_us, Word x, Word y, bool on) {
    return (on ? kOn : kOff) << 28 | static_cast<Word>(t_us & 0x3f) << 22 | x << 11 | y;
  }

  template <class Sink>
  void take(Word word, const Sink& sink) {
    const Word kind = word >> 28;
    if (kind == kTimeHigh) high_.set(word & 0xfffffff);
    if (kind > kOn || !high_.known()) return;
    sink(RawEvent{high_.value() << 6 | (word >> 22 & 0x3f), word >> 11 & 0x7ff, word & 0x7ff,
                  kind == kOn ? 1 : 0});
  }

 private:
  ClockHigh high_{28};
};

// Words of 16 bits, which change a state: row, column, polarity, and the halves of the clock.
class Evt3 {
 public:
  using Word = std::uint16_t;
  enum Kind {
    kRow = 0x0,
    kRowOfLevels = 0x1,  // of cameras that measure grey levels, too: what follows are no changes
    kColumn = 0x2,
    kFirstColumn = 0x3,
    kTwelveColumns = 0x4,
    kEightColumns = 0x5,
    kTimeLow = 0x6,
    kTimeHigh = 0x8
  };

  template <class Sink>
  void take(Word word, const Sink& sink) {
    const std::int64_t kind = word >> 12, bits = word & 0xfff;
    const std::int64_t pixel = word & 0x7ff, polarity = word >> 11 & 1;
    if (kind == kRow || kind == kRowOfLevels) {
      y_ = pixel;
      are_changes_ = kind == kRow;
    } else if (kind == kColumn) {
      emit(pixel, polarity, sink);
    } else if (kind == kFirstColumn) {
      x_ = pixel;
      polarity_ = polarity;
    } else if (kind == kTwelveColumns) {
      emit_columns(bits, 12, sink);
    } else if (kind == kEightColumns) {
      emit_columns(bits, 8, sink);
    } else if (kind == kTimeLow) {
      low_us_ = bits;
    } else if (kind == kTimeHigh) {
      // It comes again every 16 us, which leaves the lower half as it is.
      if (high_.set(bits)) low_us_ = 0;
    }
  }

 private:
  template <class Sink>
  void emit(std::int64_t x, std::int64_t polarity, const Sink& sink) const {
    if (!are_changes_ || !high_.known()) return;
    sink(RawEvent{high_.value() << 12 | low_us_, x, y_, polarity});
  }

  // A bit for each column, the lowest the leftmost. The next such word goes on to their right.
  template <class Sink>
  void emit_columns(std::int64_t bits, int count, const Sink& sink) {
    for (int i = 0; i < count; ++i) {
      if ((bits >> i & 1) != 0) emit(x_ + i, polarity_, sink);
    }
    x_ += count;
  }

  ClockHigh high_{12};
  std::int64_t low_us_ = 0, x_ = 0, y_ = 0, polarity_ = 0;
  bool are_changes_ = true;
};

}  // namespace dodgesim
