#include "sim/events/pixel_array.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "sim/base/error.h"

namespace dodgesim {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr double kArmed = -std::numeric_limits<double>::infinity();
constexpr double kNever = std::numeric_limits<double>::infinity();

// A pixel that was held at its last sample is held for so long at least, whatever rounding says.
constexpr double kHeldUs = 1e-9;

// Of an OFF and an ON event.
constexpr std::array<double, 2> kSign = {-1, 1};

// A bandwidth of second order bends S between samples; it is followed to within this share of the
// thresholds that are set, before mismatch.
constexpr double kCurveShare = 0.005;

// Flags, 0 or 1, are looked at so many at a time.
constexpr std::size_t kFlags = 64;

// Bit i is flag i.
std::uint64_t bits_of(const unsigned char* flags) {
  std::uint64_t bits = 0;
#if defined(__SSE2__)
  constexpr std::size_t kBytes = sizeof(__m128i);
  for (std::size_t i = 0; i < kFlags; i += kBytes) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(flags + i));
    const int some = _mm_movemask_epi8(_mm_cmpgt_epi8(bytes, _mm_setzero_si128()));
    bits |= static_cast<std::uint64_t>(some) << i;
  }
#else
  constexpr std::size_t kBytes = sizeof(std::uint64_t);
  constexpr std::uint64_t kGather = 0x0102040810204080u;  // byte i's lowest bit to bit 56 + i
  for (std::size_t i = 0; i < kFlags; i += kBytes) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, flags + i, kBytes);
    bits |= bytes * kGather >> 56 << i;
  }
#endif
  return bits;
}

// Rows whose candidates are run together: enough to hide the way to memory, few enough for what
// they need to stay in the cache.
constexpr int kBandRows = 8;

// Of a time that is not negative; llround would be a call.
TimeUs rounded(double us) {
  return static_cast<TimeUs>(us + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

[[noreturn, gnu::cold]] void refuse(float luminance) {
  std::ostringstream text;
  text << "An event camera was shown a luminance of " << luminance
       << "; it must be finite and not negative.";
  throw SimulationError(text.str());
}

inline float checked(float luminance) {
  if (!(luminance >= 0 && luminance <= std::numeric_limits<float>::max())) refuse(luminance);
  return luminance;
}

}  // namespace

PixelArray::PixelArray(const EventCameraSpec& spec, int width, int height,
                       std::span<const Thresholds> thresholds, const RandomStream& start,
                       bool keep_causes)
    : width_(static_cast<std::size_t>(width)),
      refractory_us_(static_cast<double>(spec.refractory_us)),
      start_(start),
      pixels_(width_ * static_cast<std::size_t>(height)),
      row_keeps_times_(static_cast<std::size_t>(height)),
      sampled_us_(pixels_.size()),
      may_fire_((width_ + kFlags - 1) / kFlags * kFlags) {
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    pixels_[i].change = {-thresholds[i].off, thresholds[i].on};
  }
  // One current for all pixels, such that their mean rate is leak_hz.
  const double inverse = mean_inverse(thresholds).on;
  const double leak_per_s = inverse > 0 ? spec.leak_hz / inverse : 0;
  leak_per_us_ = 1e-6 * leak_per_s;
  const double tolerance =
      kCurveShare * std::min(spec.contrast_threshold_on, spec.contrast_threshold_off);
  const bool exact = spec.photoreceptor_hz <= 0 && spec.follower_hz <= 0 && spec.leak_hz <= 0;
  signal_ = exact ? make_exact_signal(spec, pixels_.size())
                  : make_filtered_signal(spec, pixels_.size(), leak_per_s, tolerance);
  if (keep_causes) causes_.emplace(thresholds, leak_per_us_);
}

void PixelArray::reset(TimeUs t_us, const Picture& picture, const Noise& noise) {
  for (std::size_t i = 0; i < pixels_.size(); ++i) checked(picture.luminance[i]);
  signal_->reset(picture.luminance);
  reset_us_ = t_us;
  last_us_ = 0;
  std::fill(row_keeps_times_.begin(), row_keeps_times_.end(), 0);
  if (causes_) causes_->reset();
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    Pixel& pixel = pixels_[i];
    double leaked = 0;
    if (leak_per_us_ > 0 && !pixel.dead()) {
      const double noise_hz = noise.rate_hz(static_cast<std::uint32_t>(i), picture.luminance[i]);
      const double period_s = 1e-6 * pixel.threshold_on() / leak_per_us_;
      const double u = unit_interval(start_.block(i)[0]);
      leaked = 1e6 * leak_per_us_ * since_reset_s(u, period_s, noise_hz);
    }
    pixel.reference = signal_->value(i, 0) - leaked;
    pixel.held_until_us = kArmed;
    if (causes_) causes_->leaks_from(i, leaked > 0 ? -leaked / leak_per_us_ : 0);
  }
  set_all_bounds();
  show(whole(), picture, 0);
}

void PixelArray::sample(TimeUs t_us, const Rect& region, const Picture& picture,
                        std::span<const NoiseEvent> noise, TimeUs origin_us, EventWords& events) {
  const auto now_us = static_cast<double>(t_us - reset_us_);
  Run state = {noise, origin_us - reset_us_, &events, shown_by(picture)};
  std::span<const NoiseEvent> unlisted = noise;
  for (int y = region.y0; y < region.y1;) {
    candidates_.clear();
    signal_->begin();
    for (const int end = std::min(y + kBandRows, region.y1); y < end; ++y) {
      sample_row(y, now_us, region, picture, unlisted);
    }
    signal_->finish(candidates_);
    solve_crossings(now_us);
    run_all(now_us, state);
  }
  show(region, picture, now_us);
  if (region == whole()) {
    std::fill(row_keeps_times_.begin(), row_keeps_times_.end(), 0);
    last_us_ = now_us;
  } else {
    for (int y = region.y0; y < region.y1; ++y) {
      keep_times(static_cast<std::size_t>(y), region, now_us);
    }
  }
}

// Finds the pixels of a row that may fire, and lists them as candidates.
void PixelArray::sample_row(int y, double t_us, const Rect& region, const Picture& picture,
                            std::span<const NoiseEvent>& noise) {
  const auto row = static_cast<std::size_t>(y);
  const auto x0 = static_cast<std::size_t>(region.x0);
  RowPart part{};
  part.first = row * width_ + x0;
  part.size = static_cast<std::size_t>(region.x1 - region.x0);
  part.luminance = picture.luminance + part.first;
  part.t_us = t_us;
  part.last_us = row_keeps_times_[row] != 0 ? sampled_us_.data() + part.first : nullptr;
  part.same_last_us = last_us_;
  unsigned char* const flags = may_fire_.data();
  std::memset(flags + part.size, 0, may_fire_.size() - part.size);
  signal_->scan(part, flags);
  for (; !noise.empty() && noise.front().pixel < part.first + part.size; noise = noise.subspan(1)) {
    flags[noise.front().pixel - part.first] = 1;
  }
  places_.clear();
  for (std::size_t first = 0; first < part.size; first += kFlags) {
    for (std::uint64_t bits = bits_of(flags + first); bits != 0; bits &= bits - 1) {
      const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(bits));
      checked(part.luminance[i]);
      places_.push_back(static_cast<std::uint32_t>(i));
      __builtin_prefetch(&pixels_[part.first + i], 1);
    }
  }
  signal_->take(part, places_, candidates_);
}

void PixelArray::keep_times(std::size_t y, const Rect& region, double t_us) {
  double* const times = sampled_us_.data() + y * width_;
  if (row_keeps_times_[y] == 0) std::fill_n(times, width_, last_us_);
  row_keeps_times_[y] = 1;
  std::fill(times + region.x0, times + region.x1, t_us);
}

// First events, and second ones of those that may have another.
void PixelArray::solve_crossings(double t1_us) {
  const auto pixel_of = [&](const Candidate& c, double held_us) -> Crossings::Pixel {
    const Pixel& pixel = pixels_[c.index];
    return {c.s0,           c.s1,    t1_us - c.t0_us, c.rise_per_us,
            c.decay_per_us, held_us, pixel.reference, pixel.change[0],
            pixel.change[1]};
  };
  crossings_.begin(candidates_.size());
  for (const Candidate& c : candidates_) {
    const double held_until_us = pixels_[c.index].held_until_us;
    const bool held = held_until_us != kArmed;
    crossings_.add(pixel_of(c, held ? std::max(kHeldUs, held_until_us - c.t0_us) : 0.0));
  }
  crossings_.solve(refractory_us_);
  second_.begin(candidates_.size());
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (crossings_.answer(i) != Crossings::kAgain) continue;
    second_.add(pixel_of(candidates_[i], crossings_.crossing_us(i) + refractory_us_));
  }
  second_.solve(refractory_us_);
}

// Most pixels make one event or two or none, at crossings that are known; the others are followed
// piece by piece.
void PixelArray::run_all(double t1_us, Run& run_state) {
  std::size_t next_second = 0;
  bounds_.clear();
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Candidate& candidate = candidates_[i];
    const bool noisy = !run_state.noise.empty() && run_state.noise.front().pixel == candidate.index;
    const Crossings::Answer answer = crossings_.answer(i);
    const std::size_t second = answer == Crossings::kAgain ? next_second++ : 0;
    if (!noisy && answer == Crossings::kNothing) continue;
    run_state.first_us = static_cast<TimeUs>(candidate.t0_us) + 1;
    bool known = !noisy && take_crossing(candidate, crossings_, i, t1_us, run_state);
    if (known && answer == Crossings::kAgain) {
      known = second_.answer(second) != Crossings::kAgain &&
              take_crossing(candidate, second_, second, t1_us, run_state);
    }
    if (!known) run(candidate, t1_us, run_state);
    bounds_.push_back(bounds_of(candidate.index));
  }
  signal_->set_bounds(bounds_);
}

// The event of a pixel, if it has one, and what the pixel is after it or after the end of its
// refractory period. False: that is unknown.
bool PixelArray::take_crossing(const Candidate& candidate, const Crossings& crossings,
                               std::size_t i, double t1_us, Run& run) {
  const Crossings::Answer answer = crossings.answer(i);
  if (answer == Crossings::kUnknown) return false;
  if (answer == Crossings::kNothing) return true;
  Pixel& pixel = pixels_[candidate.index];
  pixel.reference = crossings.reference_after(i);
  pixel.held_until_us = kArmed;
  if (answer == Crossings::kRearmed) return true;
  const double crossing_us = candidate.t0_us + crossings.crossing_us(i);
  fire(candidate.index, crossing_us, t1_us, crossings.on(i), run);
  if (answer != Crossings::kArmed) pixel.held_until_us = crossing_us + refractory_us_;
  return true;
}

void PixelArray::run(const Candidate& candidate, double t1_us, Run& run) {
  if (candidate.decay_per_us >= 0) {
    for (const SignalPiece& piece : pieces_of(candidate.t0_us, t1_us, candidate.s0, candidate.s1,
                                              candidate.rise_per_us, candidate.decay_per_us)) {
      run_piece(candidate.index, piece, run);
    }
    return;
  }
  knots_.clear();
  signal_->knots(candidate, t1_us, knots_);
  SignalPiece line = {candidate.t0_us, t1_us, candidate.s0, candidate.s1};
  for (const Knot& knot : knots_) {
    line.t1_us = knot.t_us;
    line.s1 = knot.s;
    run_piece(candidate.index, line, run);
    line.t0_us = knot.t_us;
    line.s0 = knot.s;
  }
}

void PixelArray::run_piece(std::size_t index, const SignalPiece& piece, Run& run) {
  Pixel& pixel = pixels_[index];
  for (; !run.noise.empty() && run.noise.front().pixel == index; run.noise = run.noise.subspan(1)) {
    const NoiseEvent& event = run.noise.front();
    const auto t_us = static_cast<double>(event.t_us - reset_us_);
    if (t_us > piece.t1_us) break;
    fire_crossings(index, piece, t_us, run);
    if (pixel.held_until_us != kArmed || pixel.dead()) continue;
    emit(index, event.t_us - reset_us_, event.on, event.cause, run);
    pixel.reference = piece.at(t_us);
    if (refractory_us_ > 0) pixel.held_until_us = t_us + refractory_us_;
  }
  fire_crossings(index, piece, piece.t1_us, run);
}

// Moves the pixel along the piece up to until_us, which must not go back from call to call.
void PixelArray::fire_crossings(std::size_t index, const SignalPiece& piece, double until_us,
                                Run& run) {
  Pixel& pixel = pixels_[index];
  const double s_until = piece.at(until_us);
  const bool on = piece.s1 > piece.s0;
  // Which of both it is cannot be predicted: no branches.
  const double change = pixel.change[on];
  const double sign = kSign[on];
  while (true) {
    if (pixel.held_until_us != kArmed) {
      if (pixel.held_until_us > until_us) return;
      pixel.reference = piece.at(pixel.held_until_us);
      pixel.held_until_us = kArmed;
    }
    const double level = pixel.reference + change;
    if (sign * (s_until - level) < 0) return;
    pixel.reference = level;
    const double crossing_us = piece.time_of(level);
    fire(index, crossing_us, until_us, on, run);
    if (refractory_us_ > 0) pixel.held_until_us = crossing_us + refractory_us_;
  }
}

// The event of a crossing.
void PixelArray::fire(std::size_t index, double crossing_us, double until_us, bool on, Run& run) {
  Cause cause = kCauseScene;
  if (causes_) cause = causes_->of_crossing(index, crossing_us, on, run.shown[index]);
  // Rounded to the clock, but no later than what comes next and after the last sample.
  const TimeUs rounded_us = std::min(rounded(crossing_us), static_cast<TimeUs>(until_us));
  emit(index, std::max(rounded_us, run.first_us), on, cause, run);
}

void PixelArray::emit(std::size_t index, TimeUs t_us, bool on, Cause cause, Run& run) {
  run.events->push(t_us - run.origin_us, EventWords::address(index % width_, index / width_), on,
                   cause);
  if (causes_) causes_->leaks_from(index, static_cast<double>(t_us) + refractory_us_);
}

// Of a held pixel none holds.
SignalBounds PixelArray::bounds_of(std::size_t index) const {
  const Pixel& pixel = pixels_[index];
  const bool held = pixel.held_until_us != kArmed;
  return {static_cast<std::uint32_t>(index), held ? kNever : pixel.reference + pixel.change[0],
          held ? -kNever : pixel.reference + pixel.change[1]};
}

void PixelArray::set_all_bounds() {
  for (std::size_t first = 0; first < pixels_.size(); first += width_) {
    bounds_.clear();
    for (std::size_t i = first; i < first + width_; ++i) bounds_.push_back(bounds_of(i));
    signal_->set_bounds(bounds_);
  }
}

void PixelArray::rebase(const Picture& picture) {
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    pixels_[i].reference += signal_->rebase(i, checked(picture.luminance[i]));
  }
  set_all_bounds();
  show(whole(), picture, last_us_);
}

Rect PixelArray::whole() const {
  return {0, 0, static_cast<int>(width_), static_cast<int>(row_keeps_times_.size())};
}

const Cause* PixelArray::shown_by(const Picture& picture) const {
  if (causes_ && picture.cause == nullptr) {
    throw std::invalid_argument("A picture must say what its pixels show.");
  }
  return picture.cause;
}

void PixelArray::show(const Rect& region, const Picture& picture, double t_us) {
  if (causes_) causes_->show(region, width_, shown_by(picture), t_us, *signal_);
}

PixelState PixelArray::state(std::size_t index) const {
  const Pixel& pixel = pixels_[index];
  const bool own_time = row_keeps_times_[index / width_] != 0;
  const double t_us = own_time ? sampled_us_[index] : last_us_;
  return {signal_->value(index, t_us), pixel.reference, pixel.change[1], -pixel.change[0],
          pixel.held_until_us != kArmed};
}

}  // namespace dodgesim
