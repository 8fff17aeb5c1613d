#include "sim/events/thresholds.h"

#include <algorithm>

#include "sim/base/normal_distribution.h"

namespace dodgesim {

std::vector<Thresholds> draw_thresholds(const EventCameraSpec& spec, std::size_t pixel_count,
                                        const RandomStream& device) {
  std::vector<Thresholds> thresholds(pixel_count,
                                     {spec.contrast_threshold_on, spec.contrast_threshold_off});
  for (std::size_t i = 0; i < pixel_count; ++i) {
    auto& [on, off] = thresholds[i];
    const auto random = device.block(i);
    if (spec.mismatch_sigma > 0) {
      on += spec.mismatch_sigma * normal_quantile(unit_interval(random[0]));
      off += spec.mismatch_sigma * normal_quantile(unit_interval(random[1]));
    }
    on = std::max(on, spec.threshold_min);
    off = std::max(off, spec.threshold_min);
    if (unit_interval(random[2]) < spec.dead_pixel_fraction) on = off = Thresholds::kDead;
  }
  return thresholds;
}

MeanInverse mean_inverse(std::span<const Thresholds> thresholds) {
  MeanInverse sum;
  double alive = 0;
  for (const Thresholds& pixel : thresholds) {
    if (pixel.dead()) continue;
    sum.on += 1 / pixel.on;
    sum.off += 1 / pixel.off;
    ++alive;
  }
  return alive > 0 ? MeanInverse{sum.on / alive, sum.off / alive} : MeanInverse{};
}

}  // namespace dodgesim
