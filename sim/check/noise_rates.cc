#include "sim/check/noise_rates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/normal_distribution.h"
#include "sim/check/film.h"

namespace dodgesim {

namespace {

constexpr int kStillWidth = 320, kStillHeight = 240;
constexpr double kPixels = kStillWidth * kStillHeight;
constexpr double kDarkLux = 0;
constexpr double kSigmas = 3;
constexpr TimeUs kPictureEveryUs = 100000;
constexpr double kDurationS = 5;  // at most, and as long as the leak takes for kLeakEvents
constexpr double kLongestS = 100;
constexpr double kLeakEvents = 1.5;  // of a pixel
constexpr double kPlotFromHz = -0.1, kPlotToHz = 3.9;
constexpr int kPlotBins = 20;
constexpr double kMostEvents = 2e6;  // of a film

EventCameraSpec only_leak(const EventCameraSpec& camera) {
  EventCameraSpec spec = without_noise(camera);
  spec.leak_hz = camera.leak_hz;
  return spec;
}

EventCameraSpec only_shot_noise(const EventCameraSpec& camera) {
  EventCameraSpec spec = without_noise(camera);
  spec.shot_noise_on_hz = camera.shot_noise_on_hz;
  spec.shot_noise_off_hz = camera.shot_noise_off_hz;
  return spec;
}

EventCameraSpec only_hot_pixels(const EventCameraSpec& camera) {
  EventCameraSpec spec = without_noise(camera);
  spec.hot_pixel_fraction = camera.hot_pixel_fraction;
  return spec;
}

// A camera has too few hot pixels for telling how their rates are spread.
EventCameraSpec all_hot(const EventCameraSpec& camera) {
  EventCameraSpec spec = only_hot_pixels(camera);
  spec.hot_pixel_fraction = 1;
  spec.dead_pixel_fraction = 0;
  return spec;
}

NoiseCount count(const EventCameraSpec& spec, double lux, double duration_s, double events_hz,
                 Cause cause, std::uint64_t seed) {
  NoiseCount found;
  found.filmed = true;
  const double bounded_s = std::min(duration_s, kMostEvents / std::max(1.0, events_hz));
  const auto end_us = std::max<TimeUs>(1, static_cast<TimeUs>(1e6 * bounded_s));
  found.duration_s = seconds(end_us);
  found.per_pixel.resize(static_cast<std::size_t>(kPixels));
  found.per_pixel_on = found.per_pixel;
  EventCamera camera(spec, kStillWidth, kStillHeight, seed, 0, "check", true);
  const double luminance = lux / spec.illuminance_lux;
  const FilmedEvents filmed = record(camera, even_scene([=](TimeUs) { return luminance; }),
                                     regular_times(kPictureEveryUs, end_us + spec.latency_us));
  for (std::size_t i = 0; i < filmed.events.size(); ++i) {
    const Event& event = filmed.events[i];
    if (filmed.causes[i] != cause) {
      ++found.other;
      continue;
    }
    ++(event.polarity > 0 ? found.on : found.off);
    const std::size_t pixel = std::size_t{event.y} * kStillWidth + event.x;
    ++found.per_pixel[pixel];
    if (event.polarity > 0) ++found.per_pixel_on[pixel];
  }
  for (int y = 0; y < kStillHeight; ++y) {
    for (int x = 0; x < kStillWidth; ++x) {
      const PixelState pixel = camera.pixel(x, y);
      found.thresholds.push_back({pixel.threshold_on, pixel.threshold_off});
    }
  }
  return found;
}

// Events of a pixel that leaks from a random start: the first comes within the period, and after
// each the pixel is held first.
double leaks_expected(double period_s, double refractory_s, double duration_s) {
  const double cycle_s = period_s + refractory_s;
  const double whole_cycles = std::floor(duration_s / cycle_s);
  return whole_cycles + std::min(1.0, (duration_s - whole_cycles * cycle_s) / period_s);
}

// How long a pixel is deaf after an event of noise: its instant is rounded up to the microsecond
// in which it is held.
double hold_s(const EventCameraSpec& spec) {
  return spec.refractory_us > 0 ? seconds(spec.refractory_us) - 0.5e-6 : 0;
}

// The chance of at least n events where `mean` are expected.
double poisson_at_least(int n, double mean) {
  double chance = 1, of_k = std::exp(-mean);
  for (int k = 0; k < n; ++k) {
    chance -= of_k;
    of_k *= mean / (k + 1);
  }
  return std::max(0.0, chance);
}

void judge_leak(const NoiseCount& leak, const EventCameraSpec& spec, Check& check) {
  if (!leak.filmed) {
    check.off("noise.leak", "leak_hz is 0");
    return;
  }
  // A pixel's period goes with its threshold. Its count is one of two neighbouring numbers.
  const double inverse = mean_inverse(leak.thresholds).on;
  double expected = 0, variance = 1;  // of a whole event, for rounding
  for (const Thresholds& pixel : leak.thresholds) {
    if (pixel.dead() || spec.leak_hz == 0) continue;
    const double period_s = pixel.on * inverse / spec.leak_hz;
    const double events = leaks_expected(period_s, seconds(spec.refractory_us), leak.duration_s);
    const double part = events - std::floor(events);
    expected += events;
    variance += part * (1 - part);
  }
  const double seconds_pixels = leak.duration_s * kPixels;
  check.within("noise.leak.on", leak.on / seconds_pixels, expected / seconds_pixels,
               kSigmas * std::sqrt(variance) / seconds_pixels, "Hz", 5);
  check.within("noise.leak.off", leak.off / seconds_pixels, 0, 0, "Hz", 5);
  check.within("noise.leak.other_causes", leak.other, 0, 0, "events", 0);
}

// Events of each pixel whose shot noise has the share of its rates in the dark.
struct ShotExpected {
  std::vector<double> on;
  double on_sum = 0, off_sum = 0;
};

ShotExpected shot_expected(const NoiseCount& shot, double share, const EventCameraSpec& spec) {
  const MeanInverse inverse = mean_inverse(shot.thresholds);
  ShotExpected expected;
  for (const Thresholds& pixel : shot.thresholds) {
    if (pixel.dead()) {
      expected.on.push_back(0);
      continue;
    }
    const double on_hz = share * spec.shot_noise_on_hz / (pixel.on * inverse.on);
    const double off_hz = share * spec.shot_noise_off_hz / (pixel.off * inverse.off);
    const double events = events_expected(on_hz + off_hz, hold_s(spec), shot.duration_s);
    const double both_hz = std::max(1e-12, on_hz + off_hz);
    expected.on.push_back(events * on_hz / both_hz);
    expected.on_sum += expected.on.back();
    expected.off_sum += events * off_hz / both_hz;
  }
  return expected;
}

// The share of ON events that the pixels with the lower ON thresholds make.
void judge_by_threshold(const std::string& name, const NoiseCount& shot,
                        const ShotExpected& expected, Check& check) {
  std::vector<double> sorted;
  for (const Thresholds& pixel : shot.thresholds) {
    if (!pixel.dead()) sorted.push_back(pixel.on);
  }
  if (sorted.empty()) {
    check.off(name, "all pixels are dead");
    return;
  }
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  double on = 0, on_expected = 0;
  for (std::size_t i = 0; i < shot.thresholds.size(); ++i) {
    if (shot.thresholds[i].on >= *middle) continue;
    on += shot.per_pixel_on[i];
    on_expected += expected.on[i];
  }
  if (on_expected == 0 || shot.on == 0) {
    check.off(name, "no pixel has a lower ON threshold than most, or there is no ON event");
    return;
  }
  const double share = on_expected / expected.on_sum;
  check.within(name, on / shot.on, share, kSigmas * std::sqrt(share * (1 - share) / shot.on), "",
               4);
}

void judge_shot(const std::string& name, const NoiseCount& shot, double share,
                const EventCameraSpec& spec, Check& check) {
  if (!shot.filmed) {
    check.off(name, "shot_noise_on_hz and shot_noise_off_hz are 0");
    return;
  }
  const ShotExpected expected = shot_expected(shot, share, spec);
  const double seconds_pixels = shot.duration_s * kPixels;
  const auto judge_polarity = [&](const std::string& polarity, double events, double mean) {
    check.within(name + "." + polarity, events / seconds_pixels, mean / seconds_pixels,
                 kSigmas * std::sqrt(mean) / seconds_pixels, "Hz", 5);
  };
  judge_polarity("on", shot.on, expected.on_sum);
  judge_polarity("off", shot.off, expected.off_sum);
  judge_by_threshold(name + ".by_threshold", shot, expected, check);
  check.within(name + ".other_causes", shot.other, 0, 0, "events", 0);
}

// The mean over the hot pixels of what depends on a pixel's rate.
template <class OfRate>
double mean_over_hot_pixels(const EventCameraSpec& spec, OfRate of_rate) {
  constexpr int kParts = 2000;  // each as probable
  double sum = 0;
  for (int i = 0; i < kParts; ++i) {
    const double deviation = spec.hot_pixel_sigma * normal_quantile((i + 0.5) / kParts);
    const double mean_of_log =
        std::log(spec.hot_pixel_hz) - 0.5 * std::pow(spec.hot_pixel_sigma, 2);
    sum += of_rate(std::exp(mean_of_log + deviation));
  }
  return sum / kParts;
}

// The share of the pixels with more events than the mean, which falls with the spread.
void judge_hot_spread(const NoiseCount& all_hot, const EventCameraSpec& spec, Check& check) {
  const int most = static_cast<int>(spec.hot_pixel_hz * all_hot.duration_s);
  double above = 0;
  for (const double events : all_hot.per_pixel) above += events > most ? 1 : 0;
  const double open_s = all_hot.duration_s - most * hold_s(spec);
  const double p = mean_over_hot_pixels(spec, [&](double rate_hz) {
    return open_s > 0 ? poisson_at_least(most + 1, rate_hz * open_s) : 0;
  });
  check.within("noise.hot.above_mean", above / kPixels, p,
               kSigmas * std::sqrt(p * (1 - p) / kPixels), "", 4);
}

void judge_hot(const NoiseCounts& counts, const EventCameraSpec& spec, Check& check) {
  const NoiseCount &hot = counts.hot, &all_hot = counts.all_hot;
  if (!hot.filmed) {
    check.off("noise.hot", "hot_pixel_fraction or hot_pixel_hz is 0");
    return;
  }
  double pixels = 0;
  for (const double events : hot.per_pixel) pixels += events > 0 ? 1 : 0;
  // A hot pixel may stay silent.
  const double fires = mean_over_hot_pixels(
      spec, [&](double rate_hz) { return -std::expm1(-rate_hz * hot.duration_s); });
  const double p = spec.hot_pixel_fraction * (1 - spec.dead_pixel_fraction) * fires;
  check.within("noise.hot.pixels", pixels, p * kPixels,
               kSigmas * std::sqrt(p * (1 - p) * kPixels) + (p < 1 ? 1 : 0), "pixels", 1);
  check.within("noise.hot.other_causes", hot.other, 0, 0, "events", 0);

  const auto events_of = [&](double rate_hz) {
    return events_expected(rate_hz, hold_s(spec), all_hot.duration_s);
  };
  const double mean = mean_over_hot_pixels(spec, events_of);
  const double square =
      mean_over_hot_pixels(spec, [&](double hz) { return std::pow(events_of(hz), 2); });
  const double variance = mean + square - mean * mean;  // at most: a hold lessens it
  check.within("noise.hot.rate", (all_hot.on + all_hot.off) / (kPixels * all_hot.duration_s),
               mean / all_hot.duration_s,
               kSigmas * std::sqrt(variance / kPixels) / all_hot.duration_s, "Hz", 2);
  judge_hot_spread(all_hot, spec, check);
}

// Share of the pixels by rate, for the plot.
Series rates(const std::string& name, int colour, const NoiseCount& noise) {
  std::vector<double> hz;
  for (const double events : noise.per_pixel) hz.push_back(events / noise.duration_s);
  return histogram(name, colour, hz, kPlotFromHz, kPlotToHz, kPlotBins);
}

}  // namespace

double events_expected(double rate_hz, double hold_s, double duration_s) {
  if (rate_hz <= 0) return 0;
  const double cycle_s = hold_s + 1 / rate_hz;
  // The renewal function's asymptote: the first interval lacks the hold.
  constexpr double kManyHolds = 100;
  if (duration_s > kManyHolds * hold_s) {
    return duration_s / cycle_s + 0.5 * (hold_s / cycle_s) * (hold_s / cycle_s);
  }
  double events = 0;
  for (int n = 1; (n - 1) * hold_s < duration_s; ++n) {
    events += poisson_at_least(n, rate_hz * (duration_s - (n - 1) * hold_s));
  }
  return events;
}

NoiseCounts measure_noise(const EventCameraSpec& camera, std::uint64_t seed) {
  NoiseCounts counts;
  if (camera.leak_hz > 0) {
    const double duration_s = std::min(kLongestS, kLeakEvents / camera.leak_hz);
    counts.leak = count(only_leak(camera), kBrightLux, duration_s, camera.leak_hz * kPixels,
                        kCauseLeak, seed);
  }
  const double shot_hz = camera.shot_noise_on_hz + camera.shot_noise_off_hz;
  if (shot_hz > 0) {
    const EventCameraSpec spec = only_shot_noise(camera);
    counts.shot_dark = count(spec, kDarkLux, kDurationS, shot_hz * kPixels, kCauseShotNoise, seed);
    counts.shot_bright =
        count(spec, kBrightLux, kDurationS, shot_hz * kPixels, kCauseShotNoise, seed);
  }
  if (camera.hot_pixel_fraction > 0 && camera.hot_pixel_hz > 0) {
    const double hot_hz = camera.hot_pixel_hz * camera.hot_pixel_fraction * kPixels;
    counts.hot =
        count(only_hot_pixels(camera), kBrightLux, kDurationS, hot_hz, kCauseHotPixel, seed);
    counts.all_hot = count(all_hot(camera), kBrightLux, kDurationS, camera.hot_pixel_hz * kPixels,
                           kCauseHotPixel, seed);
  }
  return counts;
}

Check judge(const NoiseCounts& counts, const EventCameraSpec& expected) {
  Check check{
      "Noise",
      "A constant scene for some seconds, each kind of noise by itself. Rates are means "
      "over all pixels, dead ones included, and hold within three standard deviations of "
      "the counts and of the random start of the leak. A pixel in its refractory period is "
      "silent, and leak and shot noise are in inverse proportion to a pixel's thresholds: both "
      "are part of what is expected. The rate of the hot pixels, and the share of them above it, "
      "are those of a camera all of whose pixels are hot."};
  judge_leak(counts.leak, expected, check);
  judge_shot("noise.shot.dark", counts.shot_dark, 1, expected, check);
  judge_shot("noise.shot.bright", counts.shot_bright, expected.shot_noise_bright_share, expected,
             check);
  judge_hot(counts, expected, check);
  Plot plot{"Noise of a pixel on a constant scene",
            {"events of the pixel [Hz]", kPlotFromHz, kPlotToHz, false},
            {"share of the pixels", 1e-6, 1.5, true},
            {}};
  if (counts.leak.filmed) plot.series.push_back(rates("leak", 2, counts.leak));
  if (counts.shot_dark.filmed) plot.series.push_back(rates("shot, dark", 0, counts.shot_dark));
  if (counts.shot_bright.filmed)
    plot.series.push_back(rates("shot, 1000 lux", 4, counts.shot_bright));
  if (!plot.series.empty()) check.plots.push_back(plot);
  return check;
}

}  // namespace dodgesim
