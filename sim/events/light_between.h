// What pixels see between two pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/branchless.h"
#include "sim/base/time.h"
#include "sim/events/response.h"
#include "sim/events/spec.h"

namespace dodgesim {

// The time between two pictures in steps: whoever shows a camera pictures that are far apart shows
// it these in between.
//
// A camera with noise makes events all the time, however little there is to see: steps of no more
// than kLongestStepUs, so that memory need not hold more than the events of a step. Bandwidth and
// shot noise, which depend on the light, are the same for all of a step: as many steps as there are
// factors of kChange between their values in the two pictures, in the pixel where that is most, but
// no more than kMostChanges. It is the response that runs straight, not the rate: from black to
// white a single step may change a bandwidth by 1.7 (`noisy`), and shot noise by 2.8.
class LightBetween {
 public:
  static constexpr TimeUs kLongestStepUs = 50000;
  static constexpr double kChange = 1.2, kMostChanges = 100;

  // What depends on the light as base + slope * min(luminance, bright).
  struct Rate {
    float base, slope, bright;

    [[gnu::always_inline]] float at(float luminance) const {
      return larger(base + slope * smaller(luminance, bright), 0.0F);
    }
  };

  explicit LightBetween(const EventCameraSpec& spec);

  // Steps of the time from one picture to the next, of about the same length, at least 1 us.
  std::int64_t steps(TimeUs interval_us, const std::vector<float>& before,
                     const std::vector<float>& after) const;

  // The luminance of every pixel after a share, from 0 to 1, of the time from one picture to the
  // next: its response runs linearly. Where nothing changes it stays what it is.
  void at(double share, const std::vector<float>& before, const std::vector<float>& after,
          std::vector<float>& between) const;

  // Calls show(t_us, luminance) for each picture between two, in that many steps.
  template <class Show>
  void show_between(std::int64_t steps, TimeUs before_us, const std::vector<float>& before,
                    TimeUs after_us, const std::vector<float>& after, const Show& show) {
    for (std::int64_t k = 1; k < steps; ++k) {
      at(static_cast<double>(k) / static_cast<double>(steps), before, after, between_);
      show(before_us + (after_us - before_us) * k / steps, between_);
    }
  }

 private:
  double greatest_change(const std::vector<float>& before, const std::vector<float>& after) const;

  Response response_;
  bool noisy_;
  std::vector<float> between_;
  std::vector<Rate> rates_;  // bandwidth and shot noise, in any units, if they depend on the light
};

}  // namespace dodgesim
