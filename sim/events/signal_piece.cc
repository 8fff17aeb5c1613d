#include "sim/events/signal_piece.h"

#include "sim/events/logarithm.h"

namespace dodgesim {

namespace {

constexpr double kSolvedUs = 0.01;  // size of the last step
constexpr int kMostSteps = 60;      // bisection alone ends within these

}  // namespace

double SignalPiece::at(double t_us) const {
  if (t_us >= t1_us) return s1;
  const double dt_us = t_us - t0_us;
  if (decay_per_us == 0) return s0 + (s1 - s0) * dt_us / (t1_us - t0_us);
  return s0 + rise_per_us * dt_us - p * (1 - transient_left(decay_per_us * dt_us));
}

double SignalPiece::time_of(double s) const {
  if (s1 == s0) return t0_us;
  double t_us = t0_us + (s - s0) * (t1_us - t0_us) / (s1 - s0);
  if (decay_per_us == 0) return t_us;
  // Newton's method, kept between what is known to be too early and too late.
  double early_us = t0_us, late_us = t1_us;
  for (int i = 0; i < kMostSteps && late_us - early_us > kSolvedUs; ++i) {
    const double dt_us = t_us - t0_us;
    const double left = transient_left(decay_per_us * dt_us);
    const double error = (t_us < t1_us ? s0 + rise_per_us * dt_us - p * (1 - left) : s1) - s;
    ((error < 0) == (s1 > s0) ? early_us : late_us) = t_us;
    const double slope = rise_per_us - p * decay_per_us * left;
    double next_us = slope != 0 ? t_us - error / slope : early_us;
    if (!(next_us > early_us && next_us < late_us)) next_us = 0.5 * (early_us + late_us);
    const double step_us = next_us - t_us;
    t_us = next_us;
    if (step_us > -kSolvedUs && step_us < kSolvedUs) break;
  }
  return t_us;
}

SignalPieces pieces_of(double t0_us, double t1_us, double s0, double s1, double rise_per_us,
                       double decay_per_us) {
  const double dt_us = t1_us - t0_us;
  const double left = decay_per_us > 0 ? transient_left(decay_per_us * dt_us) : 1;
  if (left >= 1) return {{{{t0_us, t1_us, s0, s1}, {}}}, 1};
  const double p = (s0 + rise_per_us * dt_us - s1) / (1 - left);
  const double first_slope = rise_per_us - p * decay_per_us;
  const double last_slope = rise_per_us - p * decay_per_us * left;
  const SignalPiece whole = {t0_us, t1_us, s0, s1, rise_per_us, p, decay_per_us};
  if (!(first_slope * last_slope < 0)) return {{whole, {}}, 1};
  // Where it turns, p exp(-decay t) = rise / decay.
  const double left_at_turn = rise_per_us / (p * decay_per_us);
  const double turn_us = -natural_log(left_at_turn) / decay_per_us;
  if (!(turn_us > 0 && turn_us < dt_us)) return {{whole, {}}, 1};
  const double extreme = s0 + rise_per_us * turn_us - p * (1 - left_at_turn);
  SignalPiece before = whole, after = whole;
  before.t1_us = after.t0_us = t0_us + turn_us;
  before.s1 = after.s0 = extreme;
  after.p = p * left_at_turn;
  return {{before, after}, 2};
}

}  // namespace dodgesim
