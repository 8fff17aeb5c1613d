// The pixels of an event camera: each turns the luminance that it sees into events.
//
// A pixel answers to the signal S: the response L to the luminance (response.h), behind the
// photoreceptor's bandwidth (photoreceptor.h), plus what the leak has added to it. From sample to
// sample S runs linearly, or as a bandwidth bends it: exactly if that is of first order
// (crossings.h, signal_piece.h), else in straight pieces that stay within kCurveShare of the
// thresholds. A pixel fires an ON event when S reaches reference + C_on and an OFF event when S
// falls to reference - C_off, stamped at that crossing (Lichtsteiner et al. 2008; the event model
// (1) of Falanga et al. 2020); the reference then moves to the level that was crossed, so one
// interval may hold several events of a pixel.
//
// Refractory period: as in the real pixel, whose differencing amplifier is kept in reset after an
// event, the pixel is held for `refractory_us` and re-armed at its end with reference = S at that
// instant. What S does in between makes no event.
//
// Noise events reset the pixel like any other event: the reference becomes the S of that instant.
// They are lost when they fall into a refractory period, and in dead pixels.
//
// After each sample -C_off < S - reference < C_on at every pixel that is not held: no pixel is ever
// stuck. Without bandwidth, leak and noise, events and stamps are computed in double precision; the
// low-passes are kept in single precision. Thresholds, hot and dead pixels belong to the device
// (EventCameraSpec::device).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/random.h"
#include "sim/base/time.h"
#include "sim/camera/camera.h"
#include "sim/events/crossings.h"
#include "sim/events/event_words.h"
#include "sim/events/noise.h"
#include "sim/events/pixel_causes.h"
#include "sim/events/pixel_signal.h"
#include "sim/events/signal_piece.h"
#include "sim/events/spec.h"
#include "sim/events/thresholds.h"

namespace dodgesim {

// One pixel as it is after its last sample, for self-tests.
struct PixelState {
  double signal = 0;  // S; the response to the luminance where there is no bandwidth and no leak
  double reference = 0;
  double threshold_on = 0;
  double threshold_off = 0;
  bool held = false;  // in its refractory period
};

// Luminance of a picture (width x height, row-major from the top left), finite and >= 0, and
// optionally what each pixel shows.
struct Picture {
  const float* luminance;
  const Cause* cause = nullptr;
};

class PixelArray {
 public:
  // `thresholds` are the pixels', `start` draws how near each is to its first leak event.
  // With `keep_causes`, every picture must say what its pixels show.
  PixelArray(const EventCameraSpec& spec, int width, int height,
             std::span<const Thresholds> thresholds, const RandomStream& start, bool keep_causes);

  // The first picture, of the instant t_us: sets every reference, with a leak as after a long rest
  // in this light, in which the noise has reset pixels, too.
  void reset(TimeUs t_us, const Picture& picture, const Noise& noise);

  // A sample of the pixels of `region`, later than all others. Appends their events since their
  // last samples, with times since origin_us, which no last sample precedes. `noise` holds their
  // noise events of that time by (pixel, time).
  void sample(TimeUs t_us, const Rect& region, const Picture& picture,
              std::span<const NoiseEvent> noise, TimeUs origin_us, EventWords& events);

  // Another picture of the instant of the last sample, which was one of all pixels: references move
  // with it, no events.
  void rebase(const Picture& picture);

  PixelState state(std::size_t index) const;

 private:
  // Aligned: one line of the cache holds all of a pixel.
  struct alignas(32) Pixel {
    double reference = 0;
    double held_until_us = 0;  // not rounded as the stamps are; kArmed: not held
    // Of S since the reference, to an OFF event (negative) and to an ON event; infinite: dead.
    std::array<double, 2> change{};

    double threshold_on() const { return change[1]; }
    bool dead() const { return std::isinf(change[1]); }
  };
  // What run() needs besides the pixel.
  struct Run {
    std::span<const NoiseEvent> noise;  // not yet used
    TimeUs origin_us;                   // since the reset
    EventWords* events;
    const Cause* shown;   // by the picture of the new sample; only with causes
    TimeUs first_us = 0;  // earliest stamp of the pixel
  };

  void sample_row(int y, double t_us, const Rect& region, const Picture& picture,
                  std::span<const NoiseEvent>& noise);
  void keep_times(std::size_t y, const Rect& region, double t_us);
  void solve_crossings(double t1_us);
  void run_all(double t1_us, Run& run);
  bool take_crossing(const Candidate& candidate, const Crossings& crossings, std::size_t i,
                     double t1_us, Run& run);
  void run(const Candidate& candidate, double t1_us, Run& run);
  void run_piece(std::size_t index, const SignalPiece& piece, Run& run);
  void fire_crossings(std::size_t index, const SignalPiece& piece, double until_us, Run& run);
  void fire(std::size_t index, double crossing_us, double until_us, bool on, Run& run);
  void emit(std::size_t index, TimeUs t_us, bool on, Cause cause, Run& run);
  SignalBounds bounds_of(std::size_t index) const;
  void set_all_bounds();
  Rect whole() const;
  const Cause* shown_by(const Picture& picture) const;
  void show(const Rect& region, const Picture& picture, double t_us);

  std::size_t width_;
  double refractory_us_;
  double leak_per_us_ = 0;
  RandomStream start_;
  TimeUs reset_us_ = 0;
  double last_us_ = 0;  // of the last sample of all pixels
  std::vector<Pixel> pixels_;
  std::unique_ptr<PixelSignal> signal_;

  // Rows that have been sampled in parts since the last sample of all pixels keep pixels' times.
  std::vector<unsigned char> row_keeps_times_;
  std::vector<double> sampled_us_;

  std::optional<PixelCauses> causes_;

  // Scratch of one call.
  std::vector<unsigned char> may_fire_;  // of a row
  std::vector<std::uint32_t> places_;    // of the row's candidates
  std::vector<Candidate> candidates_;
  Crossings crossings_;  // of the candidates
  Crossings second_;     // of those with two
  std::vector<Knot> knots_;
  std::vector<SignalBounds> bounds_;  // of candidates, anew
};

}  // namespace dodgesim
