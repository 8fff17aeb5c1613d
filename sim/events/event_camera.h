// The event camera: turns luminance pictures into events.
//
// A pixel answers to L = ln(eps + I), which runs linearly from sample to sample. A sample is a
// whole picture or, in between, a region of one: only the pixels in it then have a sample. A pixel
// fires an ON event when L reaches reference + C_on and an OFF event when L falls to reference -
// C_off, stamped at that crossing (Lichtsteiner et al. 2008; the event model (1) of Falanga et al.
// 2020); the reference then moves to the level that was crossed, so one interval may hold several
// events of a pixel.
//
// Refractory period: as in the real pixel, whose differencing amplifier is kept in reset after an
// event, the pixel is held for `refractory_us` and re-armed at its end with reference = L at that
// instant. What L does in between makes no event.
//
// Background events (see background.h) reset the pixel like any other event: the reference becomes
// the L of that instant. They are lost when they fall into a refractory period.
//
// After each update -C_off < L - reference < C_on at every pixel that is not held: no pixel is ever
// stuck. Events and stamps are computed in double precision; thresholds and hot pixels belong to
// the device and stay the same for all throws of a seed.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/base/time.h"
#include "sim/events/background.h"
#include "sim/events/event.h"
#include "sim/events/spec.h"
#include "sim/render/camera.h"

namespace dodgesim {

// One pixel as it is after the last update, for self-tests.
struct PixelState {
  double log_luminance = 0;
  double reference = 0;
  double threshold_on = 0;
  double threshold_off = 0;
  bool held = false;  // in its refractory period
};

class EventCamera {
 public:
  // `name` tells the cameras of a vehicle apart. Throws std::invalid_argument for an empty or too
  // large (65536) picture.
  EventCamera(const EventCameraSpec& spec, int width, int height, std::uint64_t seed,
              std::uint64_t throw_index, std::string_view name);

  // The first picture, of the instant t_us: sets every reference to its L.
  // Pictures: width x height, row-major from the top left, linear luminance, finite and >= 0.
  void reset(TimeUs t_us, const float* luminance);

  // A part of the picture of the instant t_us, which is later than the last sample, be it a picture
  // or a region. `luminance` is width x height; only the pixels of `region`, which must lie in the
  // image, are read and kept. The next update() makes events of them.
  void add_region(TimeUs t_us, const Rect& region, const float* luminance);

  // The next picture, of t_us later than the last sample. Appends the events in (previous picture,
  // t_us] in (t, y, x, polarity) order. Throws SimulationError for luminance that is negative or
  // not finite, also in the regions since the previous picture.
  void update(TimeUs t_us, const float* luminance, std::vector<Event>& out);

  // Another picture of the instant of the last picture, after a change that is no event of the
  // scene (a thrown object comes into existence). References move with it, so that it makes no
  // events. No region may have come since.
  void rebase(const float* luminance);

  int width() const { return width_; }
  int height() const { return height_; }
  TimeUs time_us() const { return t_us_; }
  PixelState pixel(int x, int y) const;

 private:
  struct alignas(32) Pixel {  // half a cache line
    double reference = 0;
    double threshold_on = 0;
    double threshold_off = 0;
    double gain_on = 1;        // exp(threshold_on): the luminance ratio that fires
    double gain_off = 1;       // exp(-threshold_off)
    double held_until_us = 0;  // not rounded as the stamps are; kArmed: not held
  };
  // Straight line of L between two samples.
  struct Line {
    double t0_us, t1_us;
    double l0, l1;
    double at(double t_us) const;
    double time_of(double l) const;
  };

  // A sample of one pixel.
  struct Knot {
    TimeUs t_us;
    double l;
  };
  // A pixel that may fire in this update, with its samples from picture to picture.
  struct Candidate {
    std::uint32_t x;
    std::size_t first_knot, end_knot;  // in knots_
  };
  // The sample of a region since the last picture.
  struct Patch {
    TimeUs t_us;
    Rect rect;
    std::size_t first;  // its luminance in patch_luminance_, row by row
  };

  void update_row(int y, TimeUs t_us, const float* luminance);
  void flag_patches(std::size_t begin, int y);
  void find_candidates(std::size_t begin, int y, const float* now);
  void add_knots(std::size_t begin, int y, TimeUs t_us, const float* now, Candidate& candidate);
  const float* row_of(const Patch& patch, int y) const;
  void update_pixel(std::size_t index, int y, const Candidate& candidate);
  void fire_crossings(Pixel& pixel, const Line& line, TimeUs until_us, std::uint64_t address);
  void emit(TimeUs t_us, std::uint64_t address, bool on);
  void set_bounds(std::size_t index);
  void sort_events();
  double log_luminance(float luminance) const;

  EventCameraSpec spec_;
  double refractory_us_;
  int width_;
  int height_;
  TimeUs t_us_ = 0;
  std::vector<Pixel> pixels_;
  BackgroundActivity background_;
  BackgroundActivity hot_pixels_;

  // What the quick test of every pixel reads: a luminance strictly between low_ and high_ makes no
  // event. The bounds are slightly too narrow, never too wide, and empty for a held pixel.
  std::vector<float> low_;
  std::vector<float> high_;
  std::vector<float> previous_;  // the last picture

  std::vector<Patch> patches_;  // since the last picture, in order
  std::vector<float> patch_luminance_;

  // Scratch of one update.
  std::vector<const Patch*> row_patches_;  // that have pixels of the current row
  std::vector<std::uint8_t> row_flags_;    // candidates of the current row
  std::vector<Candidate> candidates_;      // of the current row
  std::vector<Knot> knots_;                // of the candidates
  std::vector<BackgroundEvent> noise_;     // by (pixel, time)
  std::size_t next_noise_ = 0;
  std::vector<std::uint64_t> keys_;  // events as sortable words
  std::vector<std::uint64_t> sorted_keys_;
};

}  // namespace dodgesim
