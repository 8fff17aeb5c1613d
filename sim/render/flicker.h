// The flicker of lamps on the mains: their power, and so the light of the room, swings at twice the
// mains' frequency.
#pragma once

#include "sim/base/time.h"

namespace dodgesim {

struct FlickerSpec {
  double flicker_hz = 0;
  double flicker_depth = 0.2;

  template <class Visitor>
  void visit(Visitor& v) {
    v("flicker_hz", flicker_hz, 0, 200,
      "Frequency at which the room's light swings: 100 on mains of 50 Hz, 120 on 60 Hz. The whole "
      "image is then drawn 20 times in each period, more often with a depth above 0.2. 0: the "
      "light is steady.");
    v("flicker_depth", flicker_depth, 0, 1,
      "By how much of its mean the light swings up and down, as a sine (assumed: 0.2; an "
      "incandescent lamp about 0.1, a cheap LED up to 1).");
  }
};

// By what the mean luminance is multiplied at t_us: 1 + depth sin(2 pi f t + phase), at least 0.
double flicker_factor(const FlickerSpec& spec, double phase_rad, TimeUs t_us);

// The rate at which an image must be sampled so that straight lines follow the swing; 0 for none.
double flicker_sampling_hz(const FlickerSpec& spec);

}  // namespace dodgesim
