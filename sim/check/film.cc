#include "sim/check/film.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "sim/base/random.h"

namespace dodgesim {

namespace {

constexpr int kWaves = 8;
constexpr double kShortestWavePx = 8;
constexpr double kLongestWavePx = 40;
constexpr double kMeanLuminance = 0.4;
constexpr double kLogRms = 0.5;

}  // namespace

Scene even_scene(std::function<double(TimeUs t_us)> luminance) {
  return [luminance = std::move(luminance)](TimeUs t_us, std::vector<float>& picture) {
    std::ranges::fill(picture, static_cast<float>(luminance(t_us)));
  };
}

DriftingTexture::DriftingTexture(int width, int height, double speed_pxps, std::uint64_t seed)
    : width_(width), height_(height), speed_pxps_(speed_pxps) {
  RandomStream random(seed, 0, "check/texture");
  for (int i = 0; i < kWaves; ++i) {
    const double direction = random.uniform(0, 2 * std::numbers::pi);
    const double k = 2 * std::numbers::pi / random.uniform(kShortestWavePx, kLongestWavePx);
    waves_.push_back({k * std::cos(direction), k * std::sin(direction),
                      random.uniform(0, 2 * std::numbers::pi)});
  }
}

void DriftingTexture::operator()(TimeUs t_us, std::vector<float>& luminance) const {
  const double shift_px = speed_pxps_ * seconds(t_us);
  const double amplitude = kLogRms / std::sqrt(0.5 * kWaves);
  std::vector<double> row(static_cast<std::size_t>(width_));
  for (int y = 0; y < height_; ++y) {
    std::ranges::fill(row, 0.0);
    for (const Wave& wave : waves_) {
      const double start = wave.ky * y - wave.kx * shift_px + wave.phase;
      const std::complex<double> step = std::polar(1.0, wave.kx);
      std::complex<double> value = std::polar(amplitude, start);
      for (double& sum : row) {
        sum += value.real();
        value *= step;
      }
    }
    float* const out = luminance.data() + static_cast<std::ptrdiff_t>(y) * width_;
    for (std::size_t x = 0; x < row.size(); ++x) {
      out[x] = static_cast<float>(kMeanLuminance * std::exp(row[x]));
    }
  }
}

std::vector<TimeUs> regular_times(TimeUs step_us, TimeUs end_us) {
  std::vector<TimeUs> times;
  for (TimeUs t_us = 0; t_us < end_us; t_us += step_us) times.push_back(t_us);
  times.push_back(end_us);
  return times;
}

FilmedEvents record(EventCamera& camera, const Scene& scene, std::span<const TimeUs> times) {
  const auto pixels =
      static_cast<std::size_t>(camera.width()) * static_cast<std::size_t>(camera.height());
  std::vector<float> luminance(pixels);
  const std::vector<Cause> cause(pixels, kCauseScene);
  scene(times.front(), luminance);
  camera.reset(times.front(), {luminance.data(), cause.data()});
  return record_on(camera, scene, times.subspan(1));
}

FilmedEvents record_on(EventCamera& camera, const Scene& scene, std::span<const TimeUs> times) {
  const auto pixels =
      static_cast<std::size_t>(camera.width()) * static_cast<std::size_t>(camera.height());
  std::vector<float> luminance(pixels);
  const std::vector<Cause> cause(pixels, kCauseScene);
  FilmedEvents filmed;
  for (const TimeUs t_us : times) {
    scene(t_us, luminance);
    camera.update(t_us, {luminance.data(), cause.data()}, filmed.events);
    filmed.causes.insert(filmed.causes.end(), camera.causes().begin(), camera.causes().end());
  }
  return filmed;
}

EventCameraSpec without_noise(EventCameraSpec spec) {
  spec.leak_hz = 0;
  spec.shot_noise_on_hz = spec.shot_noise_off_hz = 0;
  spec.hot_pixel_fraction = 0;
  spec.jitter_us = 0;
  spec.readout_max_hz = 0;
  spec.stamp_resolution_us = 1;
  return spec;
}

double slowest_hz(const EventCameraSpec& spec) {
  double hz = std::numeric_limits<double>::infinity();
  if (spec.follower_hz > 0) hz = spec.follower_hz;
  if (spec.photoreceptor_hz > 0) hz = std::min(hz, spec.photoreceptor_dark_hz);
  return hz;
}

}  // namespace dodgesim
