#include "sim/events/light_between.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "sim/base/vector_level.h"
#include "sim/events/noise.h"

namespace dodgesim {

namespace {

// By which factor, at least 1, a rate grows or falls in the pixel where it changes most.
[[gnu::always_inline]] inline float greatest_factor(const LightBetween::Rate& rate,
                                                    const float* before, const float* after,
                                                    std::size_t size) {
  std::int32_t greatest = std::bit_cast<std::int32_t>(1.0F);
  for (std::size_t i = 0; i < size; ++i) {
    const float a = rate.at(before[i]), b = rate.at(after[i]);
    const float factor = a == b ? 1.0F : larger(a, b) / smaller(a, b);
    // Of numbers that are not negative the bits have the same order, and need no thought of NaN.
    const auto bits = std::bit_cast<std::int32_t>(factor);
    greatest = bits > greatest ? bits : greatest;
  }
  return std::bit_cast<float>(greatest);
}

// Responses in between, as luminance.
[[gnu::always_inline]] inline void mix(const Response& response, double share, const float* before,
                                       const float* after, float* between, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    const double l = (1 - share) * response.at(before[i]) + share * response.at(after[i]);
    const auto mixed = static_cast<float>(larger(0.0, response.inverse(l)));
    between[i] = before[i] == after[i] ? before[i] : mixed;
  }
}

}  // namespace

LightBetween::LightBetween(const EventCameraSpec& spec)
    : response_(spec.log_epsilon, spec.linear_below) {
  const bool shot_noise = spec.shot_noise_on_hz > 0 || spec.shot_noise_off_hz > 0;
  noisy_ = spec.leak_hz > 0 || shot_noise || spec.hot_pixel_fraction > 0;
  const auto bright = static_cast<float>(kBrightLux / spec.illuminance_lux);
  if (spec.photoreceptor_hz > 0) {  // in units of the bandwidth at a luminance of 1 less the dark's
    const double dark_lux = kBrightLux * spec.photoreceptor_dark_hz / spec.photoreceptor_hz;
    rates_.push_back({static_cast<float>(dark_lux / spec.illuminance_lux), 1,
                      std::numeric_limits<float>::infinity()});
  }
  if (shot_noise && spec.shot_noise_bright_share < 1) {  // in units of the dark's
    const ShotNoiseShare share(spec);
    const auto dark_share = static_cast<float>(share.at(0)),
               bright_share = static_cast<float>(share.at(bright));
    rates_.push_back({dark_share, (bright_share - dark_share) / bright, bright});
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
  const auto greatest = compiled_for<greatest_factor>(vector_level());
  float change = 1;
  for (const Rate& rate : rates_) {
    change = std::max(change, greatest(rate, before.data(), after.data(), before.size()));
  }
  return change;
}

void LightBetween::at(double share, const std::vector<float>& before,
                      const std::vector<float>& after, std::vector<float>& between) const {
  constexpr std::size_t kBlock = 64;
  const auto mix_block = compiled_for<mix>(vector_level());
  between = before;
  for (std::size_t i = 0; i < before.size(); i += kBlock) {
    const std::size_t size = std::min(kBlock, before.size() - i);
    if (std::equal(&before[i], &before[i] + size, &after[i])) continue;
    mix_block(response_, share, &before[i], &after[i], &between[i], size);
  }
}

}  // namespace dodgesim
