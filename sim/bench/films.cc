#include "sim/bench/films.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "sim/base/random.h"

namespace dodgesim {

namespace {

constexpr int kWaves = 40;
constexpr double kShortestWavePx = 10;
constexpr double kLongestWavePx = 40;
constexpr double kMeanLuminance = 0.5;
constexpr double kLogSigma = 0.5;  // of ln(luminance) over the picture
constexpr int kStretchPx = 64;
constexpr int kSubPixels = 4;  // positions between two pixels that are kept; linear in between

// A sum of plane waves of random direction, length and phase.
class Texture {
 public:
  Texture() {
    RandomStream random(1, 0, "bench/texture");
    for (Wave& wave : waves_) {
      const double direction = random.uniform(0, 2 * std::numbers::pi);
      const double k = 2 * std::numbers::pi / random.uniform(kShortestWavePx, kLongestWavePx);
      wave = {k * std::cos(direction), k * std::sin(direction),
              random.uniform(0, 2 * std::numbers::pi)};
    }
  }

  double luminance(double x, double y) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::cos(wave.kx * x + wave.ky * y + wave.phase);
    return kMeanLuminance * std::exp(kLogSigma * sum / std::sqrt(0.5 * kWaves));
  }

 private:
  struct Wave {
    double kx, ky, phase;
  };
  std::array<Wave, kWaves> waves_;
};

// Forth and back between 0 and the stretch.
double triangle(double distance_px) {
  const double phase = std::fmod(distance_px, 2.0 * kStretchPx);
  return std::min(phase, 2.0 * kStretchPx - phase);
}

}  // namespace

MovingPicture drifting_texture(int width, int height, double speed_px) {
  // planes[s] holds the texture at x + s / kSubPixels, wide enough for the whole stretch.
  const int plane_width = width + kStretchPx + 1;
  auto planes = std::make_shared<std::vector<std::vector<float>>>(kSubPixels + 1);
  const Texture texture;
  for (int s = 0; s <= kSubPixels; ++s) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < plane_width; ++x) {
        const double at = x + static_cast<double>(s) / kSubPixels;
        (*planes)[static_cast<std::size_t>(s)].push_back(
            static_cast<float>(texture.luminance(at, y)));
      }
    }
  }
  return [=](std::int64_t k, std::vector<float>& luminance) {
    const double shift = kSubPixels * triangle(speed_px * static_cast<double>(k));
    const auto steps = static_cast<std::ptrdiff_t>(shift);
    const auto share = static_cast<float>(shift - std::floor(shift));
    const auto plane = static_cast<std::size_t>(steps % kSubPixels);
    for (std::ptrdiff_t y = 0; y < height; ++y) {
      const std::ptrdiff_t begin = y * plane_width + steps / kSubPixels;
      const float* const a = (*planes)[plane].data() + begin;
      const float* const b = (*planes)[plane + 1].data() + begin;
      float* const row = luminance.data() + y * width;
      for (std::ptrdiff_t x = 0; x < width; ++x) row[x] = a[x] + share * (b[x] - a[x]);
    }
  };
}

MovingPicture quiet_texture(int width, int height) {
  constexpr std::int64_t kPictures = 16;
  constexpr double kSteps = 255;
  constexpr double kDarkest = 20;  // a step is then 5 %
  const Texture texture;
  std::vector<double> base;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      base.push_back(
          std::clamp(std::floor(kSteps * texture.luminance(x, y)), kDarkest, kSteps - 1));
    }
  }
  auto pictures = std::make_shared<std::vector<std::vector<float>>>();
  RandomStream random(1, 0, "bench/flicker");
  for (std::int64_t k = 0; k < kPictures; ++k) {
    std::vector<float>& picture = pictures->emplace_back();
    for (const double step : base) {
      picture.push_back(static_cast<float>((step + (random.next_u32() & 1u)) / kSteps));
    }
  }
  return [pictures](std::int64_t k, std::vector<float>& luminance) {
    luminance = (*pictures)[static_cast<std::size_t>(k % kPictures)];
  };
}

}  // namespace dodgesim
