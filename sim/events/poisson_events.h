// Events without a cause in the scene, at random instants.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/random.h"
#include "sim/base/time.h"
#include "sim/base/weighted_choice.h"

namespace dodgesim {

struct PoissonEvent {
  TimeUs t_us = 0;
  std::uint32_t pixel = 0;  // y * width + x
  bool on = false;
  double chance = 0;  // uniform in (0, 1), for whoever wants to keep only a share of the events
};

// How often a pixel makes events [1/s].
struct PixelRate {
  std::uint32_t pixel = 0;
  double on_hz = 0, off_hz = 0;
};

// A Poisson process of each pixel and polarity, drawn as one process of the summed rate whose
// events fall on random pixels. Event number n is a pure function of the stream, so the events do
// not depend on the instants at which the process is asked for them.
class PoissonEvents {
 public:
  PoissonEvents(const RandomStream& stream, const std::vector<PixelRate>& rates);

  // Starts again at event number 0; the first event follows t_us.
  void reset(TimeUs t_us);

  // Appends the events after those of the last call and up to t_us, in order of time.
  void take_until(TimeUs t_us, std::vector<PoissonEvent>& out);

 private:
  void draw();

  RandomStream stream_;
  std::vector<std::uint32_t> pixels_;
  WeightedChoice choice_;    // 2 k: pixels_[k] makes an OFF event, 2 k + 1: an ON event
  double mean_wait_us_ = 0;  // 0: the process is silent
  std::uint64_t number_ = 0;
  double time_us_ = 0;  // of the next event, since origin_us_
  TimeUs origin_us_ = 0;
  PoissonEvent next_;
};

}  // namespace dodgesim
