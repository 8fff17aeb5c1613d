// Why the pixels of an event camera fire: the ground truth of their events (cause.h).
//
// A pixel that an object enters or leaves between two samples fires because of the object, and does
// so until its bandwidth lets go of the object's light; of two objects, because of the one that
// enters.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/events/cause.h"
#include "sim/events/pixel_signal.h"
#include "sim/events/thresholds.h"

namespace dodgesim {

class PixelCauses {
 public:
  // Of pixels with these thresholds, row-major, and a leak that raises S by so much.
  PixelCauses(std::span<const Thresholds> thresholds, double leak_per_us);

  // All pixels show the scene.
  void reset();

  // The pixels of `region`, in an image `width` wide, show what `picture` (as large) says at t_us,
  // the instant of their last sample in `signal`.
  void show(const Rect& region, std::size_t width, const Cause* picture, double t_us,
            const PixelSignal& signal);

  // A pixel begins to leak anew.
  void leaks_from(std::size_t index, double t_us) { leaks_from_us_[index] = t_us; }

  // Of a crossing at t_us of a pixel that shows `now`: the leak if it made most of the change.
  Cause of_crossing(std::size_t index, double t_us, bool on, Cause now) const {
    if (on && leak_per_us_ * (t_us - leaks_from_us_[index]) > 0.5 * threshold_on_[index]) {
      return kCauseLeak;
    }
    return now != kCauseScene ? now : shown_[index];
  }

 private:
  void show(std::size_t index, Cause now, double t_us, const PixelSignal& signal);

  double leak_per_us_;
  std::vector<double> threshold_on_;
  std::vector<double> rest_;        // of an object's light in S that makes no more events
  std::vector<Cause> shown_;        // by each pixel's last sample, or an object shortly before it
  std::vector<double> settled_us_;  // until when, if the object has left; else infinite
  std::vector<double> leaks_from_us_;
};

}  // namespace dodgesim
