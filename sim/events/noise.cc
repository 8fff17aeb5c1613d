#include "sim/events/noise.h"

#include <algorithm>
#include <string>

#include "sim/base/normal_distribution.h"
#include "sim/events/logarithm.h"
#include "sim/events/stream_name.h"

namespace dodgesim {

namespace {

std::vector<PixelRate> rates_of_shot_noise(const EventCameraSpec& spec,
                                           std::span<const Thresholds> thresholds) {
  if (spec.shot_noise_on_hz + spec.shot_noise_off_hz <= 0) return {};
  const MeanInverse inverse = mean_inverse(thresholds);
  std::vector<PixelRate> rates(thresholds.size());
  for (std::uint32_t i = 0; i < rates.size(); ++i) {
    rates[i].pixel = i;
    if (thresholds[i].dead()) continue;
    rates[i].on_hz = spec.shot_noise_on_hz / (thresholds[i].on * inverse.on);
    rates[i].off_hz = spec.shot_noise_off_hz / (thresholds[i].off * inverse.off);
  }
  return rates;
}

// The inverse of the distribution of these rates, which is log-normal.
double hot_pixel_rate_hz(const EventCameraSpec& spec, double u) {
  const double sigma = spec.hot_pixel_sigma;
  return spec.hot_pixel_hz * natural_exp(sigma * (normal_quantile(u) - sigma / 2));
}

std::vector<PixelRate> rates_of_hot_pixels(const EventCameraSpec& spec, std::size_t pixel_count,
                                           const RandomStream& device) {
  const double shot_hz = spec.shot_noise_on_hz + spec.shot_noise_off_hz;
  const double on_share = shot_hz > 0 ? spec.shot_noise_on_hz / shot_hz : 0.5;
  std::vector<PixelRate> rates;
  for (std::uint32_t i = 0; spec.hot_pixel_fraction > 0 && i < pixel_count; ++i) {
    const auto random = device.block(i);
    if (unit_interval(random[0]) >= spec.hot_pixel_fraction) continue;
    const double rate_hz = hot_pixel_rate_hz(spec, unit_interval(random[1]));
    rates.push_back({i, on_share * rate_hz, (1 - on_share) * rate_hz});
  }
  return rates;
}

}  // namespace

// The inverse of the distribution of that time, an exponential that ends with the period.
double since_reset_s(double u, double leak_period_s, double noise_hz) {
  constexpr double kRare = 1e-6, kOften = 600;
  const double resets = noise_hz * leak_period_s;
  if (resets < kRare) return u * leak_period_s;
  return -natural_log(1 - u * (1 - natural_exp(-std::min(resets, kOften)))) / noise_hz;
}

Noise::Noise(const EventCameraSpec& spec, int width, std::span<const Thresholds> thresholds,
             std::uint64_t seed, std::uint64_t throw_index, std::string_view name)
    : width_(width),
      shot_share_(spec),
      shot_rates_(rates_of_shot_noise(spec, thresholds)),
      hot_rates_(rates_of_hot_pixels(
          spec, thresholds.size(),
          RandomStream(seed, spec.device_index(throw_index), stream_name(name, "hot pixels")))),
      shot_(RandomStream(seed, throw_index, stream_name(name, "shot")), shot_rates_),
      hot_(RandomStream(seed, throw_index, stream_name(name, "hot")), hot_rates_) {}

void Noise::reset(TimeUs t_us) {
  shot_.reset(t_us);
  hot_.reset(t_us);
  waiting_.clear();
}

double Noise::rate_hz(std::uint32_t pixel, float luminance) const {
  const auto sum = [](const PixelRate& rate) { return rate.on_hz + rate.off_hz; };
  const auto hot = std::ranges::lower_bound(hot_rates_, pixel, {}, &PixelRate::pixel);
  const double shot_hz = shot_rates_.empty() ? 0 : sum(shot_rates_[pixel]);
  return shot_hz * shot_share_.at(luminance) +
         (hot != hot_rates_.end() && hot->pixel == pixel ? sum(*hot) : 0);
}

std::span<const NoiseEvent> Noise::take(TimeUs t_us, const Rect& region, const float* luminance) {
  drawn_.clear();
  shot_.take_until(t_us, drawn_);
  for (const PoissonEvent& event : drawn_) waiting_.push_back({event, kCauseShotNoise});
  drawn_.clear();
  hot_.take_until(t_us, drawn_);
  for (const PoissonEvent& event : drawn_) waiting_.push_back({event, kCauseHotPixel});

  taken_.clear();
  std::erase_if(waiting_, [&](const Waiting& waiting) {
    const auto& [event, cause] = waiting;
    const auto x = static_cast<int>(event.pixel) % width_;
    const auto y = static_cast<int>(event.pixel) / width_;
    if (x < region.x0 || x >= region.x1 || y < region.y0 || y >= region.y1) return false;
    if (cause == kCauseHotPixel || event.chance < shot_share_.at(luminance[event.pixel])) {
      taken_.push_back({event.t_us, event.pixel, event.on, cause});
    }
    return true;
  });
  std::sort(taken_.begin(), taken_.end(), [](const NoiseEvent& a, const NoiseEvent& b) {
    if (a.pixel != b.pixel) return a.pixel < b.pixel;
    return a.t_us != b.t_us ? a.t_us < b.t_us : a.on < b.on;
  });
  return taken_;
}

}  // namespace dodgesim
