#include "sim/events/luminance_bounds.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace dodgesim {

namespace {

// A positive float's bits grow with it. Kept of them are the octaves from 2^-20 to 2^12, with 2^-11
// of precision; beyond lie 0 and kMost.
constexpr std::int32_t kOrigin = (127 - 20) << 23;
constexpr int kShift = 12;
constexpr std::int32_t kMost = 65535;

[[gnu::always_inline]] inline std::int32_t packed(float x) {
  const float positive = x > 0 ? x : 0;  // what is not is refused later
  const std::int32_t octaves = (std::bit_cast<std::int32_t>(positive) - kOrigin) >> kShift;
  const std::int32_t least = octaves < 0 ? 0 : octaves;
  return least > kMost ? kMost : least;
}

struct Part {
  std::size_t size;
  const float* luminance;
  const std::uint16_t *low, *high;
  unsigned char* may_fire;
  float epsilon;
};

[[gnu::always_inline]] inline void scan_part(const Part& part) {
  const std::size_t size = part.size;
  const float* __restrict const luminance = part.luminance;
  const std::uint16_t* __restrict const low = part.low;
  const std::uint16_t* __restrict const high = part.high;
  unsigned char* __restrict const may_fire = part.may_fire;
  const float epsilon = part.epsilon;
  for (std::size_t i = 0; i < size; ++i) {
    const std::int32_t now = packed(epsilon + luminance[i]);
    const bool quiet = (now > low[i]) & (now < high[i]) & (luminance[i] >= 0);
    may_fire[i] = static_cast<unsigned char>(!quiet);
  }
}

// The bounds are rounded to float; this keeps them on the safe side.
constexpr double kMargin = 1e-6;

}  // namespace

LuminanceBounds::LuminanceBounds(std::size_t pixels, double log_epsilon)
    : epsilon_(static_cast<float>(log_epsilon)), low_(pixels), high_(pixels) {}

void LuminanceBounds::set(std::size_t pixel, double low_luminance, double high_luminance) {
  const double epsilon = epsilon_;
  const double low = (epsilon + low_luminance) * (1 + kMargin);
  const double high = (epsilon + high_luminance) * (1 - kMargin);
  const auto stored = [](double bound) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    return static_cast<std::uint16_t>(packed(static_cast<float>(std::clamp(bound, 0.0, kLargest))));
  };
  low_[pixel] = stored(low);
  high_[pixel] = stored(high);
}

void LuminanceBounds::scan(std::size_t first, std::size_t size, const float* luminance,
                           unsigned char* may_fire, int level) const {
  compiled_for<scan_part>(level)(
      {size, luminance, low_.data() + first, high_.data() + first, may_fire, epsilon_});
}

}  // namespace dodgesim
