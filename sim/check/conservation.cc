#include "sim/check/conservation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/random.h"
#include "sim/check/film.h"
#include "sim/events/response.h"

namespace dodgesim {

namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr double kSpeedPxps = 400;
constexpr int kPictures = 200;
constexpr double kShortestUs = 50, kLongestUs = 2000;  // between two pictures
constexpr int kSteps = 4;
constexpr TimeUs kSettlingUs = 200000;  // after a step, at least
constexpr double kTimeConstants = 10;   // of the slowest pixel, at least
constexpr double kMostNoise = 40;       // events of each kind while a pixel settles: memory
constexpr int kAnswerPictures = 10;

constexpr double kLongestSettlingS = 300;

// How far the signal may be beyond a threshold: the low-passes are kept in single precision.
constexpr double kSlack = 1e-5;

std::vector<TimeUs> irregular_times(std::uint64_t seed) {
  RandomStream random(seed, 0, "check/times");
  std::vector<TimeUs> times = {0};
  for (int i = 0; i < kPictures; ++i) {
    times.push_back(times.back() + static_cast<TimeUs>(random.uniform(kShortestUs, kLongestUs)));
  }
  return times;
}

bool dead(const PixelState& pixel) { return !std::isfinite(pixel.threshold_on); }

// Of the slowest pixel.
double settling_s(const EventCameraSpec& spec) {
  return kTimeConstants / (2 * std::numbers::pi * slowest_hz(spec));
}

TimeUs settling_us(const EventCameraSpec& spec) {
  return std::max(kSettlingUs,
                  static_cast<TimeUs>(1e6 * std::min(settling_s(spec), kLongestSettlingS)));
}

// Which pixels fire at a step up or one of those down and up again that follow it. A step may come
// while a pixel is held after an event of noise, so noise is an answer, too: a stuck pixel has
// none.
std::vector<bool> answers(EventCamera& camera, const EventCameraSpec& spec,
                          const DriftingTexture& texture, TimeUs end_us, double step) {
  const Response response(spec.log_epsilon, spec.linear_below);
  const TimeUs begin_us = end_us + 1;
  const TimeUs answer_us = settling_us(spec) + 2 * spec.refractory_us;  // to each step
  const Scene steps = [&](TimeUs t_us, std::vector<float>& luminance) {
    texture(end_us, luminance);
    if ((t_us - begin_us) / answer_us % 2 != 0) return;
    for (float& value : luminance) {
      value = static_cast<float>(response.inverse(response.at(value) + step));
    }
  };
  std::vector<TimeUs> times = regular_times(answer_us / kAnswerPictures, kSteps * answer_us - 1);
  for (TimeUs& t_us : times) t_us += begin_us;
  std::vector<bool> answered(static_cast<std::size_t>(kWidth) * kHeight);
  for (const Event& event : record_on(camera, steps, times).events) {
    answered[std::size_t{event.y} * kWidth + event.x] = true;
  }
  return answered;
}

}  // namespace

PixelsAfterFilm measure_conservation(const EventCameraSpec& expected, std::uint64_t seed) {
  EventCameraSpec spec = expected;
  spec.readout_max_hz = 0;  // who waits in line is not stuck
  for (double* noise_hz :
       {&spec.leak_hz, &spec.shot_noise_on_hz, &spec.shot_noise_off_hz, &spec.hot_pixel_hz}) {
    *noise_hz = std::min(*noise_hz, 1e6 * kMostNoise / static_cast<double>(settling_us(spec)));
  }
  EventCamera camera(spec, kWidth, kHeight, seed, 0, "check", true);
  const DriftingTexture texture(kWidth, kHeight, kSpeedPxps, seed);
  const std::vector<TimeUs> times = irregular_times(seed);
  record(camera, texture, times);

  PixelsAfterFilm after;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) after.pixels.push_back(camera.pixel(x, y));
  }

  // By more than any pixel can have left between its reference and a threshold.
  for (const PixelState& pixel : after.pixels) {
    if (dead(pixel)) continue;
    after.step = std::max(after.step, 1.5 * (pixel.threshold_on + pixel.threshold_off));
  }
  after.answered = answers(camera, spec, texture, times.back(), after.step);
  return after;
}

Check judge(const PixelsAfterFilm& after, const EventCameraSpec& expected) {
  Check check{
      "Conservation",
      "A drifting texture is shown at irregular instants. Then no pixel outside of its "
      "refractory period may be farther from its reference than its threshold, and a "
      "large step up, or one of the steps down and up after it, must make every pixel that is not "
      "dead fire. The readout's limit is off, and noise is limited. The plot shows how far the "
      "signals are from the references, in thresholds."};
  double beyond = 0, stuck = 0, alive = 0;
  std::vector<double> distances;
  for (std::size_t i = 0; i < after.pixels.size(); ++i) {
    const PixelState& pixel = after.pixels[i];
    if (dead(pixel)) continue;
    ++alive;
    if (!after.answered[i]) ++stuck;
    if (pixel.held) continue;
    const double distance = pixel.signal - pixel.reference;
    if (!(distance < pixel.threshold_on + kSlack && distance > -pixel.threshold_off - kSlack)) {
      ++beyond;
    }
    distances.push_back(distance / (distance > 0 ? pixel.threshold_on : pixel.threshold_off));
  }
  check.within("conservation.beyond", beyond, 0, 0, "pixels", 0);
  if (settling_s(expected) > kLongestSettlingS) {
    check.off("conservation.stuck", "too slow for a pixel to answer a step");
  } else {
    check.within("conservation.stuck", stuck, 0, 0, "pixels", 0);
  }
  const auto count = static_cast<double>(after.pixels.size());
  const double p = expected.dead_pixel_fraction;
  check.within("conservation.dead", count - alive, p * count,
               3 * std::sqrt(p * (1 - p) * count) + (p > 0 && p < 1 ? 1 : 0), "pixels", 1);
  check.plots.push_back({"After the film: distance from the reference",
                         {"(signal - reference) / threshold", -1.2, 1.2, false},
                         {"share of the pixels", 0, 0, false},
                         {histogram("", 0, distances, -1.2, 1.2, 60)}});
  return check;
}

}  // namespace dodgesim
