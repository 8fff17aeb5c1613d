// Events without a cause in the scene, at random instants.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/random.h"
#include "sim/base/time.h"

namespace dodgesim {

struct PoissonEvent {
  TimeUs t_us = 0;
  std::uint32_t pixel = 0;  // y * width + x
  bool on = false;
  double chance = 0;  // uniform in (0, 1), for whoever wants to keep only a share of the events
};

// A Poisson process over a set of pixels of equal rate, drawn as one process of the summed rate
// whose events fall on random pixels. Event number n is a pure function of the stream, so the
// events do not depend on the instants at which the process is asked for them.
class PoissonEvents {
 public:
  // `rate_hz` is per pixel, both polarities together; pixels are 0 .. pixel_count - 1.
  PoissonEvents(const RandomStream& stream, std::uint32_t pixel_count, double rate_hz,
                double on_share);
  // The same over the listed pixels only.
  PoissonEvents(const RandomStream& stream, std::vector<std::uint32_t> pixels, double rate_hz,
                double on_share);

  // Starts again at event number 0; the first event follows t_us.
  void reset(TimeUs t_us);

  // Appends the events after those of the last call and up to t_us, in order of time.
  void take_until(TimeUs t_us, std::vector<PoissonEvent>& out);

 private:
  void draw();

  RandomStream stream_;
  std::vector<std::uint32_t> pixels_;  // empty: all
  std::uint32_t pixel_count_;
  double mean_wait_us_;  // 0: the process is silent
  double on_share_;
  std::uint64_t number_ = 0;
  double time_us_ = 0;  // of the next event, since origin_us_
  TimeUs origin_us_ = 0;
  PoissonEvent next_;
};

}  // namespace dodgesim
