// Where signals first cross a level between two samples, for many pixels at once.
//
// From its last sample on, a pixel's signal runs as the input of a low-pass that rises evenly makes
// its output run: S(t) = s0 + rise t - p (1 - exp(-decay t)), with p such that S(dt) = s1; with
// decay 0 it is a straight line. Where such a curve only rises or only falls it crosses a level at
// most once, and Halley's method finds the place to within 0.01 us.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/vector_level.h"

namespace dodgesim {

class Crossings {
 public:
  // What happens to a pixel until its new sample.
  enum Answer : std::uint8_t {
    kNothing,  // no event; a pixel that is held still is
    kRearmed,  // no event; a pixel that was held is armed again
    kHeld,     // one event; it ends in its refractory period
    kArmed,    // one event; it is armed again
    kAgain,    // one event, and after its refractory period another may follow
    kUnknown,  // an event on a curve that turns, or several without a refractory period in between:
               // the caller must find out
  };

  // Of one pixel. Times count from its last sample.
  struct Pixel {
    double s0, s1, dt_us;
    double rise_per_us, decay_per_us;  // decay 0: a straight line; below: unknown
    double held_us;                    // the end of its refractory period; 0: armed
    double reference, off, on;         // events at reference + off (off < 0) and reference + on
  };

  // Starts anew, with room for so many.
  void begin(std::size_t most);
  void add(const Pixel& pixel);
  std::size_t size() const { return size_; }

  // Answers for all pixels. The same bytes at every vector level.
  void solve(double refractory_us, int level = vector_level());

  Answer answer(std::size_t i) const { return static_cast<Answer>(answer_[i]); }
  // Of pixels with an event: the crossing, and whether it is one of rising light.
  double crossing_us(std::size_t i) const { return crossing_us_[i]; }
  bool on(std::size_t i) const { return on_event_[i] != 0; }
  // Of pixels with an event or rearmed: the reference after it and after the refractory period.
  double reference_after(std::size_t i) const { return reference_after_[i]; }

 private:
  std::size_t size_ = 0;  // the vectors may be longer
  bool bent_ = false;     // is any of them
  std::vector<double> s0_, s1_, dt_us_, rise_per_us_, decay_per_us_, held_us_, reference_, off_,
      on_;
  std::vector<double> crossing_us_, reference_after_;
  // Half as wide as the numbers, so that compilers work on two vectors of these at a time: one
  // alone would wait for itself.
  std::vector<std::int32_t> answer_, on_event_;
};

}  // namespace dodgesim
