#include "sim/events/crossings.h"

#include "sim/base/branchless.h"
#include "sim/events/logarithm.h"

namespace dodgesim {

namespace {

constexpr double kSolvedUs = 0.01;  // size of the last step

constexpr std::int32_t kNothing = Crossings::kNothing, kRearmed = Crossings::kRearmed;
constexpr std::int32_t kHeld = Crossings::kHeld, kArmed = Crossings::kArmed;
constexpr std::int32_t kAgain = Crossings::kAgain, kUnknown = Crossings::kUnknown;

struct Row {
  std::size_t size;
  const double *s0, *s1, *dt_us, *rise_per_us, *decay_per_us, *held_us, *reference, *off, *on;
  double *crossing_us, *reference_after;
  std::int32_t *answer, *on_event;
  double refractory_us;
};

inline double size_of(double a) { return a < 0 ? -a : a; }

// S(t) = s0 + rise t - p (1 - exp(-decay t)), for 0 <= t <= dt.
struct Curve {
  double s0, rise, p, decay, dt;

  [[gnu::always_inline]] double at(double t_us, double left) const {
    return s0 + rise * t_us - p * (1 - left);
  }
};

// Halley's method: where S - level would be 0 if S ran on as its value, slope and bend at t_us say;
// Newton's where the bend is too large for that.
[[gnu::always_inline]] inline double halley_step(const Curve& c, double level, double start_us,
                                                 double t_us) {
  const double left = transient_left(c.decay * t_us);
  const double error = c.at(t_us, left) - level;
  const double slope = c.rise - c.p * c.decay * left;
  const double bend = c.p * c.decay * c.decay * left;
  const double slope_squared = slope * slope;
  const double damped = 2 * slope_squared - error * bend;
  const bool cubic = damped > slope_squared;
  const double above = cubic ? 2 * error * slope : error;
  const double below = cubic ? damped : slope;
  const double next_us = below != 0 ? t_us - above / below : 0.0;
  return smaller(larger(next_us, start_us), c.dt);
}

// kBent: some of the signals may be curved.
template <bool kBent>
[[gnu::always_inline]] inline void solve_row(Row row) {
  const double refractory_us = row.refractory_us;
#pragma GCC ivdep
  for (std::size_t i = 0; i < row.size; ++i) {
    const double s0 = row.s0[i], s1 = row.s1[i], dt = row.dt_us[i];
    const double off = row.off[i], on = row.on[i];
    const double given_rise = row.rise_per_us[i], given_decay = row.decay_per_us[i];
    const double decay = kBent ? larger(given_decay, 0.0) : 0.0;
    const double left = kBent ? transient_left(decay * dt) : 1.0;
    const bool straight = left >= 1;
    const double rise = straight ? (s1 - s0) / dt : given_rise;
    const double p = straight ? 0.0 : (s0 + rise * dt - s1) / (straight ? 1.0 : 1 - left);
    const Curve curve = {s0, rise, p, decay, dt};

    // From the end of its refractory period on.
    const double start = row.held_us[i];
    const bool was_held = start > 0, still_held = start > dt;
    const double left_start = kBent ? transient_left(decay * start) : 1.0;
    const double s_start = was_held ? curve.at(start, left_start) : s0;
    const double reference = was_held ? s_start : row.reference[i];
    const bool turns = (rise - p * decay * left_start) * (rise - p * decay * left) < 0;
    // Where it turns, p exp(-decay t) = rise / decay.
    const double tau = 1 / (turns ? decay : 1.0), lag = rise * tau;
    const double turn_us = natural_log(turns ? p / lag : 1.0) * tau;
    const double extreme = turns ? s0 + rise * turn_us - p + lag : s1;
    const bool within = (extreme > reference + off) & (extreme < reference + on);

    const bool up = s1 > s_start;
    const double level = reference + (up ? on : off);
    const bool crosses = ((up ? s1 - level : level - s1) >= 0) & (!still_held);

    // Starts at the chord; two steps are nearly always enough.
    const double chord_us = crosses ? start + (level - s_start) * (dt - start) / (s1 - s_start) : 0;
    double before = chord_us, t = chord_us;
    if constexpr (kBent) {
      const double t1 = halley_step(curve, level, start, chord_us);
      before = halley_step(curve, level, start, t1);
      t = halley_step(curve, level, start, before);
    }

    const double armed_us = t + refractory_us;
    const bool held = (refractory_us > 0) & (armed_us > dt);
    const double left_armed = kBent ? transient_left(decay * armed_us) : 1.0;
    const double s_armed = curve.at(armed_us, left_armed);
    const double after = (refractory_us > 0) & (!held) ? s_armed : level;
    const double room = smaller(after + on - s1, s1 - (after + off));
    const bool again = crosses & !held & !(room > 0);
    const bool unsolved = crosses & !(size_of(t - before) < kSolvedUs);
    const bool unknown = (!still_held) & ((given_decay < 0) | (turns & (crosses | !within)) |
                                          (again & !(refractory_us > 0)) | unsolved);
    row.crossing_us[i] = t;
    row.reference_after[i] = crosses ? after : reference;
    row.on_event[i] = up ? 1 : 0;
    const std::int32_t last = held ? kHeld : kArmed;
    const std::int32_t event = again ? kAgain : last;
    const std::int32_t none = was_held & (!still_held) ? kRearmed : kNothing;
    const std::int32_t answer = crosses ? event : none;
    row.answer[i] = unknown ? kUnknown : answer;
  }
}

}  // namespace

void Crossings::begin(std::size_t most) {
  size_ = 0;
  bent_ = false;
  if (most <= answer_.size()) return;
  for (auto* values : {&s0_, &s1_, &dt_us_, &rise_per_us_, &decay_per_us_, &held_us_, &reference_,
                       &off_, &on_, &crossing_us_, &reference_after_}) {
    values->resize(most);
  }
  answer_.resize(most);
  on_event_.resize(most);
}

void Crossings::add(const Pixel& pixel) {
  const std::size_t i = size_++;
  bent_ |= pixel.decay_per_us > 0;
  s0_[i] = pixel.s0;
  s1_[i] = pixel.s1;
  dt_us_[i] = pixel.dt_us;
  rise_per_us_[i] = pixel.rise_per_us;
  decay_per_us_[i] = pixel.decay_per_us;
  held_us_[i] = pixel.held_us;
  reference_[i] = pixel.reference;
  off_[i] = pixel.off;
  on_[i] = pixel.on;
}

void Crossings::solve(double refractory_us, int level) {
  const Row row = {size(),          s0_.data(),          s1_.data(),
                   dt_us_.data(),   rise_per_us_.data(), decay_per_us_.data(),
                   held_us_.data(), reference_.data(),   off_.data(),
                   on_.data(),      crossing_us_.data(), reference_after_.data(),
                   answer_.data(),  on_event_.data(),    refractory_us};
  const auto solve =
      bent_ ? compiled_for<solve_row<true>>(level) : compiled_for<solve_row<false>>(level);
  solve(row);
}

}  // namespace dodgesim
