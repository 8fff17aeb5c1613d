#include "sim/events/pixel_causes.h"

#include <algorithm>
#include <limits>

namespace dodgesim {

namespace {

// An object that has left makes a pixel's events until S is within this share of the lower
// threshold from where the scene's light leads it.
constexpr double kSettledShare = 0.1;

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

PixelCauses::PixelCauses(std::span<const Thresholds> thresholds, double leak_per_us)
    : leak_per_us_(leak_per_us),
      shown_(thresholds.size()),
      settled_us_(thresholds.size()),
      leaks_from_us_(thresholds.size()) {
  for (const Thresholds& pixel : thresholds) {
    threshold_on_.push_back(pixel.on);
    rest_.push_back(kSettledShare * std::min(pixel.off, pixel.on));
  }
}

void PixelCauses::reset() { std::fill(shown_.begin(), shown_.end(), kCauseScene); }

void PixelCauses::show(const Rect& region, std::size_t width, const Cause* picture, double t_us,
                       const PixelSignal& signal) {
  for (int y = region.y0; y < region.y1; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * width;
    const std::size_t end = row + static_cast<std::size_t>(region.x1);
    for (std::size_t i = row + static_cast<std::size_t>(region.x0); i < end; ++i) {
      show(i, picture[i], t_us, signal);
    }
  }
}

void PixelCauses::show(std::size_t index, Cause now, double t_us, const PixelSignal& signal) {
  Cause& shown = shown_[index];
  double& settled_us = settled_us_[index];
  if (now != kCauseScene) {
    shown = now;
    settled_us = kNever;
  } else if (shown != kCauseScene) {
    if (settled_us == kNever) settled_us = t_us + signal.settles_in_us(index, rest_[index]);
    if (settled_us <= t_us) shown = kCauseScene;
  }
}

}  // namespace dodgesim
