// The photoreceptor's bandwidth: a low-pass of the pixel's response to light, whose cut-off falls
// with the light, and optionally a second one (the source follower) with a fixed cut-off. The
// follower alone is a low-pass of first order.
//
// The input u is the response at the samples and runs linearly between them. The outputs y (first
// order) and z (second order) at the samples are then known (single precision; z to within 3e-5 of
// the changes in the interval). With x = dt/tau, k = exp(-x) and m = (1 - k)/x, over one interval:
//   y1 = u1 + k (y0 - u0) - m (u1 - u0)
// and, as y is a line plus (y0 - u0 + (u1 - u0)/x) exp(-t/tau), z1 follows likewise. tau is that of
// the interval's light, the mean of its two samples'.
#pragma once

#include <cstddef>

#include "sim/base/vector_level.h"
#include "sim/events/response.h"

namespace dodgesim {

struct EventCameraSpec;

// What a pixel's low-passes hold.
struct Charge {
  double u = 0;  // the response to the last sample's light
  double y = 0;  // behind the photoreceptor
  double z = 0;  // behind the second low-pass; y if there is none
};

class Photoreceptor {
 public:
  explicit Photoreceptor(const EventCameraSpec& spec);

  int order() const { return order_; }  // of the low-pass: 0, 1 or 2
  // In single precision, as rows are.
  float response(float luminance) const { return response_.at(luminance); }

  // Cut-off [1/s, angular] of the first, or only, low-pass at a luminance.
  double cutoff_rad_s(double luminance) const { return dark_rad_s_ + rad_s_ * luminance; }

  // How far z is behind u that rises evenly at a luminance; of orders 1 and 2.
  double lag_s(double luminance) const {
    return 1 / cutoff_rad_s(luminance) + (order_ > 1 ? 1 / follower_rad_s_ : 0);
  }

  // One pixel, t_s after a sample; at dt_s > 0 after it, the response is u1. `luminance` is the
  // light in between.
  Charge at(const Charge& before, double luminance, double u1, double dt_s, double t_s) const;

  // Of a low-pass of second order: how long z may be taken to run straight from `now` on without
  // straying by more than `tolerance`, while u rises by slope_1s at that luminance. Infinite: for
  // ever.
  double straight_s(const Charge& now, double luminance, double slope_1s, double tolerance) const;

  // A row of pixels.
  struct Row {
    std::size_t size;
    const float* luminance;
    const float* dt_s;  // since each pixel's last sample; null: same_dt_s
    float same_dt_s;
    // Of the last sample, replaced by this one's. Its luminance (`light`) and y if the order is at
    // least 1, z if it is 2; else null.
    float *light, *u, *y, *z;
    float *light0, *u0, *y0, *z0;  // what they were
    // Bounds of z: a pixel whose z stays strictly between them makes no event.
    const float *low, *high;
    float leaked_before, leaked;  // what the leak has added to z before and after
    unsigned char* may_fire;      // 1: z may have left its bounds, or the luminance is no number
  };
  // In single precision; the same bytes at every vector level (see sim/base/vector_level.h).
  void advance(const Row& row, int level = vector_level()) const;

 private:
  ResponseOf<float> response_;
  int order_;
  double rad_s_, dark_rad_s_, follower_rad_s_;
};

}  // namespace dodgesim
