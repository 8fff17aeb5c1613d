#include "sim/events/light_between.h"

#include <algorithm>

namespace dodgesim {

LightBetween::LightBetween(const EventCameraSpec& spec)
    : response_(spec.log_epsilon, spec.linear_below),
      noisy_(spec.leak_hz > 0 || spec.shot_noise_on_hz > 0 || spec.shot_noise_off_hz > 0 ||
             spec.hot_pixel_fraction > 0) {}

std::int64_t LightBetween::steps(TimeUs interval_us) const {
  return noisy_ ? (interval_us + kLongestStepUs - 1) / kLongestStepUs : 1;
}

void LightBetween::at(double share, const std::vector<float>& before,
                      const std::vector<float>& after, std::vector<float>& between) const {
  between.resize(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] == after[i]) {
      between[i] = before[i];
      continue;
    }
    const double l = (1 - share) * response_.at(before[i]) + share * response_.at(after[i]);
    between[i] = static_cast<float>(std::max(0.0, response_.inverse(l)));
  }
}

}  // namespace dodgesim
