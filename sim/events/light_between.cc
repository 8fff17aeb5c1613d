#include "sim/events/light_between.h"

#include <algorithm>
#include <cmath>

namespace dodgesim {

namespace {

// By which factor a rate grows or falls in the pixel where it changes most.
template <class Rate>
double greatest_factor(const std::vector<float>& before, const std::vector<float>& after,
                       const Rate& rate) {
  float least = 1, most = 1;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const float factor = rate(after[i]) / rate(before[i]);
    least = std::min(least, factor);
    most = std::max(most, factor);
  }
  return std::max<double>(most, 1 / least);
}

}  // namespace

LightBetween::LightBetween(const EventCameraSpec& spec)
    : response_(spec.log_epsilon, spec.linear_below),
      bandwidth_changes_(spec.photoreceptor_hz > 0),
      dark_luminance_(0),
      shot_noise_share_(spec) {
  const bool shot_noise = spec.shot_noise_on_hz > 0 || spec.shot_noise_off_hz > 0;
  noisy_ = spec.leak_hz > 0 || shot_noise || spec.hot_pixel_fraction > 0;
  shot_noise_changes_ = shot_noise && spec.shot_noise_bright_share < 1;
  if (bandwidth_changes_) {
    const double dark_lux = kBrightLux * spec.photoreceptor_dark_hz / spec.photoreceptor_hz;
    dark_luminance_ = static_cast<float>(dark_lux / spec.illuminance_lux);
  }
}

std::int64_t LightBetween::steps(TimeUs interval_us, const std::vector<float>& before,
                                 const std::vector<float>& after) const {
  const std::int64_t in_time = noisy_ ? (interval_us + kLongestStepUs - 1) / kLongestStepUs : 1;
  const double changes = std::log(greatest_change(before, after)) / std::log(kChange);
  const auto in_light = static_cast<std::int64_t>(std::ceil(std::min(changes, kMostChanges)));
  return std::clamp<std::int64_t>(std::max(in_time, in_light), 1, interval_us);
}

double LightBetween::greatest_change(const std::vector<float>& before,
                                     const std::vector<float>& after) const {
  double change = 1;
  if (bandwidth_changes_) {
    change = greatest_factor(before, after,
                             [this](float luminance) { return dark_luminance_ + luminance; });
  }
  if (shot_noise_changes_) {
    const auto share = [this](float luminance) {
      return static_cast<float>(shot_noise_share_.at(luminance));
    };
    change = std::max(change, greatest_factor(before, after, share));
  }
  return change;
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
