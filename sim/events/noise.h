// The noise of an event camera that is not in its pixels' signal: shot noise, which falls with the
// light and comes more often the lower a pixel's threshold is (in inverse proportion, as v2e
// has it: Hu et al. 2021), and hot pixels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/time.h"
#include "sim/camera/camera.h"
#include "sim/events/cause.h"
#include "sim/events/poisson_events.h"
#include "sim/events/spec.h"
#include "sim/events/thresholds.h"

namespace dodgesim {

struct NoiseEvent {
  TimeUs t_us = 0;
  std::uint32_t pixel = 0;  // y * width + x
  bool on = false;
  Cause cause = kCauseShotNoise;
};

// How long ago, at an instant after a long rest, a pixel was last reset [s]: by noise, at random,
// or by its leak, once it has been spared for a whole period. `u` is uniform in (0, 1).
double since_reset_s(double u, double leak_period_s, double noise_hz);

// Which share of the shot noise in the dark is left in the light.
class ShotNoiseShare {
 public:
  explicit ShotNoiseShare(const EventCameraSpec& spec)
      : bright_share_(spec.shot_noise_bright_share),
        bright_luminance_(kBrightLux / spec.illuminance_lux) {}

  double at(float luminance) const {
    return 1 - (1 - bright_share_) * std::min(1.0, luminance / bright_luminance_);
  }

 private:
  double bright_share_;
  double bright_luminance_;  // from which on the share is bright_share_
};

class Noise {
 public:
  // `thresholds` are the pixels', row by row; `name` tells the cameras of a vehicle apart. Which
  // pixels are hot depends on the device (EventCameraSpec::device), the spec and the name.
  Noise(const EventCameraSpec& spec, int width, std::span<const Thresholds> thresholds,
        std::uint64_t seed, std::uint64_t throw_index, std::string_view name);

  void reset(TimeUs t_us);

  // Of all noise of a pixel that sees this luminance [1/s].
  double rate_hz(std::uint32_t pixel, float luminance) const;

  // The events up to t_us of the pixels in `region` that have not been taken before, by (pixel,
  // time). `luminance` (width x height) is what these pixels see. Valid until the next call.
  std::span<const NoiseEvent> take(TimeUs t_us, const Rect& region, const float* luminance);

 private:
  int width_;
  ShotNoiseShare shot_share_;
  std::vector<PixelRate> shot_rates_;  // of all pixels, in the dark; empty: none
  std::vector<PixelRate> hot_rates_;   // of the hot pixels, in order
  PoissonEvents shot_;
  PoissonEvents hot_;
  struct Waiting {
    PoissonEvent event;
    Cause cause;
  };
  std::vector<PoissonEvent> drawn_;  // scratch
  std::vector<Waiting> waiting_;     // for a sample of their pixels
  std::vector<NoiseEvent> taken_;
};

}  // namespace dodgesim
