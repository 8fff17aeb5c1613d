#include "sim/check/refractory.h"

#include <algorithm>
#include <cmath>

#include "sim/check/film.h"
#include "sim/check/quantile.h"

namespace dodgesim {

namespace {

constexpr int kRampWidth = 40, kRampHeight = 30;
constexpr double kFromLux = 1e4, kToLux = 1e8;  // so bright that the pixels are fast
constexpr int kRampPictures = 200;
constexpr double kThresholdShare = 0.25;  // what the light takes for a threshold, of the period
constexpr double kShortestTakesUs = 50;   // at least
constexpr double kSettlesShare = 0.5;     // of the film
constexpr double kIntervalLimit = 0.02;
constexpr double kRoundedUs = 1;  // both stamps of an interval are rounded
constexpr double kRampSigmas = 4;

double log_light(const EventCameraSpec& spec, double lux) {
  return std::log(spec.log_epsilon + lux / spec.illuminance_lux);
}

// ln(eps + I) grows evenly, until film_us.
Scene growing_light(const EventCameraSpec& spec, TimeUs film_us) {
  const double from = log_light(spec, kFromLux), by = log_light(spec, kToLux) - from;
  return even_scene([=](TimeUs t_us) {
    const auto grown_us = static_cast<double>(std::min(t_us, film_us));
    return std::exp(from + by * grown_us / static_cast<double>(film_us)) - spec.log_epsilon;
  });
}

std::vector<Event> film_of(const EventCameraSpec& spec, std::uint64_t seed, TimeUs film_us) {
  EventCamera camera(spec, kRampWidth, kRampHeight, seed, 0, "check", true);
  const TimeUs every_us = std::max<TimeUs>(1, film_us / kRampPictures);
  // Long enough for the last events to come out.
  const TimeUs late_us = spec.latency_us + spec.stamp_resolution_us;
  return record(camera, growing_light(spec, film_us), regular_times(every_us, film_us + late_us))
      .events;
}

// Stamps of each pixel in their order.
std::vector<std::vector<TimeUs>> by_pixel(const std::vector<Event>& events) {
  std::vector<std::vector<TimeUs>> stamps(static_cast<std::size_t>(kRampWidth) * kRampHeight);
  for (const Event& event : events) {
    stamps[std::size_t{event.y} * kRampWidth + event.x].push_back(event.t_us);
  }
  return stamps;
}

// Between the events of a pixel, from those on that come when the light has settled.
std::vector<double> intervals_after(double settled_us, const std::vector<TimeUs>& stamps_us) {
  std::vector<double> intervals_us;
  for (std::size_t i = 1; i < stamps_us.size(); ++i) {
    if (static_cast<double>(stamps_us[i - 1]) < settled_us) continue;
    intervals_us.push_back(static_cast<double>(stamps_us[i] - stamps_us[i - 1]));
  }
  return intervals_us;
}

}  // namespace

RampEvents measure_ramp(const EventCameraSpec& camera, std::uint64_t seed) {
  EventCameraSpec spec = without_noise(camera);
  const double swing = log_light(spec, kToLux) - log_light(spec, kFromLux);
  RampEvents measured;
  measured.threshold_takes_us =
      std::max(kShortestTakesUs, kThresholdShare * static_cast<double>(camera.refractory_us));
  const auto film_us =
      static_cast<TimeUs>(measured.threshold_takes_us * swing / spec.contrast_threshold_on);
  const auto fine = by_pixel(film_of(spec, seed, film_us));
  spec.stamp_resolution_us = camera.stamp_resolution_us;
  const auto coarse = by_pixel(film_of(spec, seed, film_us));
  for (std::size_t pixel = 0; pixel < fine.size(); ++pixel) {
    const std::vector<double> intervals_us =
        intervals_after(kSettlesShare * static_cast<double>(film_us), fine[pixel]);
    measured.intervals_us.insert(measured.intervals_us.end(), intervals_us.begin(),
                                 intervals_us.end());
    if (!fine[pixel].empty()) {
      measured.pixel_medians_us.push_back(intervals_us.empty() ? INFINITY
                                                               : quantile(intervals_us, 0.5));
    }
    for (std::size_t i = 0; i < std::min(fine[pixel].size(), coarse[pixel].size()); ++i) {
      measured.rounded_by_us.push_back(static_cast<double>(coarse[pixel][i] - fine[pixel][i]));
      measured.stamps_us.push_back(coarse[pixel][i]);
    }
  }
  return measured;
}

Check judge(const RampEvents& measured, const EventCameraSpec& expected) {
  Check check{"Refractory period and clock",
              "The light grows evenly in its logarithm. After each event a pixel is held for the "
              "refractory period and then waits until the light has grown by its threshold: the "
              "median time between two events of a pixel is the sum of both, in the median over "
              "the pixels, and no two are nearer than the period. With the clock's resolution the "
              "same events come later, by half of "
              "it on average. Noise, jitter and the readout's limit are off.",
              {},
              {}};
  const std::vector<double>& intervals = measured.intervals_us;
  const auto period_us = static_cast<double>(expected.refractory_us);
  const std::vector<double>& medians = measured.pixel_medians_us;
  if (intervals.empty() || std::isinf(quantile(medians, 0.5))) {
    check.off("refractory", "the thresholds are too high for two events of a pixel");
  } else {
    const double median_us = period_us + measured.threshold_takes_us;
    const double chance_us = kRampSigmas * kMedianSigma * measured.threshold_takes_us *
                             expected.mismatch_sigma / expected.contrast_threshold_on /
                             std::sqrt(static_cast<double>(medians.size()));
    check.within("refractory.interval", quantile(medians, 0.5), median_us,
                 kIntervalLimit * median_us + kRoundedUs + chance_us, "us", 1);
    check.between("refractory.shortest", *std::min_element(intervals.begin(), intervals.end()),
                  period_us - kRoundedUs, median_us, "us", 0);
  }
  if (expected.stamp_resolution_us == 1 || measured.rounded_by_us.empty()) {
    check.off("clock", "stamp_resolution_us is 1, or there is no event");
    return check;
  }
  const auto [first, last] = std::ranges::minmax(measured.stamps_us);
  if (first == last) {
    check.off("clock", "stamp_resolution_us is longer than the film");
    return check;
  }
  const auto n = static_cast<double>(measured.rounded_by_us.size());
  const auto resolution_us = static_cast<double>(expected.stamp_resolution_us);
  double sum_us = 0;
  for (const double late_us : measured.rounded_by_us) sum_us += late_us;
  const auto off =
      std::count_if(measured.stamps_us.begin(), measured.stamps_us.end(),
                    [&](TimeUs stamp_us) { return stamp_us % expected.stamp_resolution_us != 0; });
  check.within("clock.off", static_cast<double>(off), 0, 0, "stamps", 0);
  // The pixels' events are alike; those of one are not.
  const double independent = n / (kRampWidth * kRampHeight);
  check.within("clock.rounded_by", sum_us / n, 0.5 * (resolution_us - 1),
               kRampSigmas * resolution_us / std::sqrt(12 * std::max(1.0, independent)), "us", 1);
  return check;
}

}  // namespace dodgesim
