#include "sim/check/readout_burst.h"

#include <algorithm>

#include "sim/check/film.h"
#include "sim/events/response.h"

namespace dodgesim {

namespace {

constexpr int kBurstWidth = 320, kMostRows = 240;
constexpr double kLongestBurstS = 1;  // that a burst should take
constexpr double kLeastHz = 1;        // with less a film would last for hours
constexpr int kBurstPictures = 100;   // while the readout works
constexpr TimeUs kBeforeBurstUs = 1000;
constexpr double kBurstRelativeLimit = 0.01;
constexpr double kClockUs = 2;       // of a burst's duration, because stamps are rounded
constexpr double kWaitLimit = 0.02;  // of the losses, as the second step takes 1 us

// Pixels that all fire at once, and once only, when the response rises by 1.2 thresholds.
EventCameraSpec even_pixels(const EventCameraSpec& camera) {
  EventCameraSpec spec = without_noise(camera);
  spec.readout_max_hz = camera.readout_max_hz;
  spec.mismatch_sigma = 0;
  spec.dead_pixel_fraction = 0;
  spec.photoreceptor_hz = spec.follower_hz = 0;
  spec.refractory_us = 0;
  return spec;
}

struct BurstFilm {
  double events = 0, lost = 0, first_us = 0, last_us = 0;
};

// Steps at the given instants after kBeforeBurstUs.
BurstFilm film(const EventCameraSpec& spec, int rows, const std::vector<TimeUs>& steps_us,
               TimeUs duration_us, std::uint64_t seed) {
  EventCamera camera(spec, kBurstWidth, rows, seed, 0, "check", true);
  const Response response(spec.log_epsilon, spec.linear_below);
  const double start = response.at(spec.linear_below + 0.1);
  const Scene scene = even_scene([&](TimeUs t_us) {
    const auto passed = std::ranges::count_if(
        steps_us, [t_us](TimeUs step_us) { return t_us > kBeforeBurstUs + step_us; });
    return response.inverse(start + 1.2 * spec.contrast_threshold_on * static_cast<double>(passed));
  });
  std::vector<TimeUs> times = {0};
  for (const TimeUs step_us : steps_us) {
    times.push_back(kBeforeBurstUs + step_us);
    times.push_back(kBeforeBurstUs + step_us + 1);
  }
  for (int i = 1; i <= kBurstPictures; ++i) {
    times.push_back(kBeforeBurstUs + 2 + duration_us * i / kBurstPictures);
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const auto events = record(camera, scene, times).events;
  BurstFilm found{static_cast<double>(events.size()), static_cast<double>(camera.lost()), 0, 0};
  if (!events.empty()) {
    found.first_us = static_cast<double>(events.front().t_us - kBeforeBurstUs);
    found.last_us = static_cast<double>(events.back().t_us - kBeforeBurstUs);
  }
  return found;
}

}  // namespace

Burst measure_burst(const EventCameraSpec& camera, std::uint64_t seed) {
  Burst burst;
  if (camera.readout_max_hz < kLeastHz) return burst;
  const EventCameraSpec spec = even_pixels(camera);
  const int rows = static_cast<int>(std::clamp(camera.readout_max_hz * kLongestBurstS / kBurstWidth,
                                               1.0, static_cast<double>(kMostRows)));
  burst.filmed = true;
  burst.pixels = rows * kBurstWidth;
  const double burst_us = 1e6 * burst.pixels / camera.readout_max_hz;
  const auto film_us = static_cast<TimeUs>(3 * burst_us) + spec.latency_us + kBurstPictures;
  const BurstFilm one = film(spec, rows, {0}, film_us, seed);
  burst.first_us = one.first_us;
  burst.duration_us = one.last_us - one.first_us;
  burst.delivered = one.events;
  burst.lost = one.lost;
  const auto half_us = std::max<TimeUs>(2, static_cast<TimeUs>(0.5 * burst_us));
  const BurstFilm two = film(spec, rows, {0, half_us}, film_us, seed);
  burst.second_made = burst.pixels;
  burst.second_delivered = two.events - one.events;
  burst.second_lost = two.lost - one.lost;
  return burst;
}

Check judge(const Burst& burst, const EventCameraSpec& expected) {
  Check check{"Readout",
              "All pixels fire at the same instant: the events leave at the rate of the readout. "
              "Then all fire again when half of them have left: the others are lost, and every "
              "loss is counted. Mismatch, bandwidth, refractory period, noise and jitter are off."};
  if (!burst.filmed) {
    check.off("readout.rate", "readout_max_hz is 0, or below 1 Hz");
    return check;
  }
  const double expected_us = 1e6 * (burst.pixels - 1) / expected.readout_max_hz;
  check.within("readout.burst", burst.duration_us, expected_us,
               kBurstRelativeLimit * expected_us + kClockUs, "us", 1);
  check.within("readout.first", burst.first_us, static_cast<double>(expected.latency_us), kClockUs,
               "us", 1);
  check.within("readout.delivered", burst.delivered, burst.pixels, 0, "events", 0);
  check.within("readout.lost", burst.lost, 0, 0, "events", 0);
  const double waiting = 0.5 * burst.pixels;
  check.within("readout.second.lost", burst.second_lost, waiting,
               kWaitLimit * burst.pixels + kClockUs * 1e-6 * expected.readout_max_hz, "events", 0);
  check.within("readout.second.not_counted",
               burst.second_made - burst.second_delivered - burst.second_lost, 0, 0, "events", 0);
  return check;
}

}  // namespace dodgesim
