// A pixel's signal between two samples, in pieces that only rise or only fall.
#pragma once

#include <array>
#include <cstddef>

namespace dodgesim {

// S(t) = s0 + rise (t - t0) - p (1 - exp(-decay (t - t0))), which is s1 at t1, and between t0 and
// t1 only rises or only falls. decay 0: a straight line from s0 to s1.
struct SignalPiece {
  double t0_us, t1_us;
  double s0, s1;
  double rise_per_us = 0, p = 0, decay_per_us = 0;

  double at(double t_us) const;
  // When S is s, which lies between s0 and s1; to within 0.01 us.
  double time_of(double s) const;
};

struct SignalPieces {
  std::array<SignalPiece, 2> piece;
  std::size_t size;

  const SignalPiece* begin() const { return piece.data(); }
  const SignalPiece* end() const { return piece.data() + size; }
};

// The output of a low-pass whose input rises evenly (see crossings.h), from s0 at t0 to s1 at t1;
// two pieces if it turns in between. decay 0: straight.
SignalPieces pieces_of(double t0_us, double t1_us, double s0, double s1, double rise_per_us,
                       double decay_per_us);

}  // namespace dodgesim
