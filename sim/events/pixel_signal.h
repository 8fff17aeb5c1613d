// The signal S of all pixels, from which they make events: two ways to compute it. Both pass over
// all pixels with vectors to find the few that may fire.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/events/spec.h"

namespace dodgesim {

// A pixel that may fire, with its signal at its last sample and at the new one. Times count from
// the reset.
struct Candidate {
  std::uint32_t index;
  std::uint32_t curve;  // for PixelSignal::knots()
  double t0_us;
  double s0, s1;
  // How S runs in between, see crossings.h. A decay below 0: as knots() says.
  double rise_per_us, decay_per_us;
};

struct Knot {
  double t_us;
  double s;
};

// A pixel makes no event while low < S < high. One with low > high is looked at at every sample.
struct SignalBounds {
  std::uint32_t index;
  double low, high;
};

// Neighbouring pixels of a row at a new sample.
struct RowPart {
  std::size_t first, size;
  const float* luminance;  // of `size` pixels
  double t_us;             // of the sample; times count from the reset
  const double* last_us;   // of each pixel's last sample; null: same_last_us for all
  double same_last_us;     // of the last sample of all pixels

  double last_sample_us(std::size_t i) const { return last_us ? last_us[i] : same_last_us; }
};

class PixelSignal {
 public:
  virtual ~PixelSignal() = default;

  virtual void reset(const float* luminance) = 0;

  // What a call of PixelArray::sample does, in this order: begin, for each row scan and take,
  // finish.
  virtual void begin() = 0;
  // may_fire[i] = 1 for pixels that may make an event, and for luminance that is negative or no
  // number, after which the signal must be reset. Until take() the part's state is of neither
  // sample.
  virtual void scan(const RowPart& part, unsigned char* may_fire) = 0;
  // Appends the candidates at the given places of the part; its new sample becomes its last one.
  virtual void take(const RowPart& part, std::span<const std::uint32_t> places,
                    std::vector<Candidate>& candidates) = 0;
  virtual void finish(std::span<Candidate> candidates) = 0;

  // Straight pieces that follow the signal of a candidate with a decay below 0 until t1_us: their
  // ends, the last included.
  virtual void knots(const Candidate& /*candidate*/, double /*t1_us*/,
                     std::vector<Knot>& /*knots*/) const {}

  virtual void set_bounds(std::span<const SignalBounds> bounds) = 0;

  // S at the pixel's last sample, of the instant t_us.
  virtual double value(std::size_t index, double t_us) const = 0;
  // How long the pixel's last light must last for S, leak aside, to come to within `rest` of where
  // that leads.
  virtual double settles_in_us(std::size_t /*index*/, double /*rest*/) const { return 0; }
  // Another luminance at that instant. Returns by how much S has changed.
  virtual double rebase(std::size_t index, float luminance) = 0;
};

// S = L, in double precision, for cameras without a bandwidth and a leak.
std::unique_ptr<PixelSignal> make_exact_signal(const EventCameraSpec& spec, std::size_t pixels);

// S = L behind the photoreceptor, plus the leak; followed to within `tolerance` between samples.
std::unique_ptr<PixelSignal> make_filtered_signal(const EventCameraSpec& spec, std::size_t pixels,
                                                  double leak_per_s, double tolerance);

}  // namespace dodgesim
