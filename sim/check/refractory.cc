#include "sim/check/refractory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/check/film.h"
#include "sim/check/quantile.h"
#include "sim/events/response.h"

namespace dodgesim {

namespace {

constexpr int kRampWidth = 40, kRampHeight = 30;
constexpr int kRampPixels = kRampWidth * kRampHeight;
// The light starts where the photoreceptor is fast, within these.
constexpr double kFromLux = 1e4, kBrightestFromLux = 1e8;
constexpr double kFastHz = 30000;
constexpr double kSwing = 9.2, kLongestSwing = 60;  // of the light's logarithm
constexpr int kRampPictures = 200;
constexpr double kThresholdShare = 0.25;  // what the light takes for a threshold, of the period
constexpr double kShortestTakesUs = 50;   // at least
constexpr double kMostThresholds = 1000;  // in a film
constexpr double kSettlesShare = 0.5;     // of the film
constexpr double kSettlesTaus = 6;        // at least
constexpr double kLongestFilmUs = 1e9;
constexpr double kIntervalLimit = 0.02;
constexpr double kRoundedUs = 1;  // both stamps of an interval are rounded
constexpr double kRampSigmas = 4;

Response response_of(const EventCameraSpec& spec) {
  return Response(spec.log_epsilon, spec.linear_below);
}

// The response of each pixel to light grows evenly for film_us, from an instant of its own on.
// These instants are spread evenly over the time from one event to the next, and so are then the
// events of all pixels, whatever the resolution of the clock.
struct Ramp {
  double from = 0;  // the response, a logarithm but to little light
  double swing = 0;
  double takes_us = 0;  // for a threshold
  double film_us = 0;
  double spread_us = 0;

  double starts_us(std::size_t pixel) const {
    return spread_us * static_cast<double>(pixel) / kRampPixels;
  }
};

// The sum of those of a pixel's low-passes.
double time_constants_us(const EventCameraSpec& spec, double lux) {
  double sum_s = 0;
  if (spec.photoreceptor_hz > 0) {
    sum_s += 1 / (spec.photoreceptor_dark_hz + spec.photoreceptor_hz * lux / kBrightLux);
  }
  if (spec.follower_hz > 0) sum_s += 1 / spec.follower_hz;
  return 1e6 * sum_s / (2 * std::numbers::pi);
}

Ramp ramp_for(const EventCameraSpec& spec) {
  double from_lux = kFromLux;
  if (spec.photoreceptor_hz > 0) {
    from_lux =
        std::clamp(kBrightLux * kFastHz / spec.photoreceptor_hz, kFromLux, kBrightestFromLux);
  }
  const double threshold = spec.contrast_threshold_on;
  Ramp ramp;
  ramp.from = response_of(spec).at(from_lux / spec.illuminance_lux);
  ramp.takes_us =
      std::max(kShortestTakesUs, kThresholdShare * static_cast<double>(spec.refractory_us));
  ramp.film_us = std::max(ramp.takes_us * kSwing / threshold,
                          kSettlesTaus * time_constants_us(spec, from_lux) / kSettlesShare);
  ramp.takes_us = std::max(
      {ramp.takes_us, ramp.film_us / kMostThresholds, ramp.film_us * threshold / kLongestSwing});
  ramp.swing = threshold * ramp.film_us / ramp.takes_us;
  ramp.spread_us = static_cast<double>(spec.refractory_us) + ramp.takes_us;
  return ramp;
}

Scene growing_light(const EventCameraSpec& spec, const Ramp& ramp) {
  return [ramp, response = response_of(spec)](TimeUs t_us, std::vector<float>& luminance) {
    for (std::size_t i = 0; i < luminance.size(); ++i) {
      const double grown =
          std::clamp((static_cast<double>(t_us) - ramp.starts_us(i)) / ramp.film_us, 0.0, 1.0);
      luminance[i] = static_cast<float>(response.inverse(ramp.from + ramp.swing * grown));
    }
  };
}

std::vector<Event> film_of(const EventCameraSpec& spec, std::uint64_t seed, const Ramp& ramp) {
  EventCamera camera(spec, kRampWidth, kRampHeight, seed, 0, "check", true);
  const auto end_us = static_cast<TimeUs>(ramp.film_us + ramp.spread_us);
  const TimeUs every_us = std::max<TimeUs>(1, end_us / kRampPictures);
  // Long enough for the last events to come out.
  const TimeUs late_us = spec.latency_us + spec.stamp_resolution_us;
  return record(camera, growing_light(spec, ramp), regular_times(every_us, end_us + late_us))
      .events;
}

// Stamps of each pixel in their order.
std::vector<std::vector<TimeUs>> by_pixel(const std::vector<Event>& events) {
  std::vector<std::vector<TimeUs>> stamps(kRampPixels);
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
  const Ramp ramp = ramp_for(spec);
  RampEvents measured;
  measured.threshold_takes_us = ramp.takes_us;
  measured.film_us = ramp.film_us;
  if (ramp.film_us > kLongestFilmUs) return measured;
  const auto fine = by_pixel(film_of(spec, seed, ramp));
  spec.stamp_resolution_us = camera.stamp_resolution_us;
  const auto coarse = by_pixel(film_of(spec, seed, ramp));
  for (std::size_t pixel = 0; pixel < fine.size(); ++pixel) {
    const std::vector<double> intervals_us =
        intervals_after(ramp.starts_us(pixel) + kSettlesShare * ramp.film_us, fine[pixel]);
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
  Check check{
      "Refractory period and clock",
      "The light grows so that the response to it does evenly, for every pixel from another "
      "instant on and for so long that its low-passes settle. After each event a pixel is held "
      "for the refractory period and then waits until the light has grown by its threshold: the "
      "median time between two events of a pixel is the sum of both, in the median over the "
      "pixels, and no two are nearer than the period. With the clock's resolution the same events "
      "come later, by half of it on average. Noise, jitter and the readout's limit are off."};
  const std::vector<double>& intervals = measured.intervals_us;
  const auto period_us = static_cast<double>(expected.refractory_us);
  const std::vector<double>& medians = measured.pixel_medians_us;
  if (intervals.empty() || std::isinf(quantile(medians, 0.5))) {
    check.off("refractory", "too slow, or thresholds too high, for two events of a pixel");
  } else {
    const double median_us = period_us + measured.threshold_takes_us;
    const double chance_us = kRampSigmas * kMedianSigma * measured.threshold_takes_us *
                             expected.mismatch_sigma / expected.contrast_threshold_on /
                             std::sqrt(static_cast<double>(medians.size()));
    const double limit_us = kIntervalLimit * median_us + kRoundedUs;
    check.within("refractory.interval", quantile(medians, 0.5), median_us, limit_us + chance_us,
                 "us", 1);
    check.between("refractory.shortest", *std::ranges::min_element(intervals),
                  period_us - kRoundedUs, median_us + limit_us + chance_us, "us", 0);
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
  const auto off = std::ranges::count_if(measured.stamps_us, [&](TimeUs stamp_us) {
    return stamp_us % expected.stamp_resolution_us != 0;
  });
  check.within("clock.off", static_cast<double>(off), 0, 0, "stamps", 0);
  // The events of a pixel may be alike; the pixels are not. The film may end within a step of the
  // clock.
  const double chance_us =
      kRampSigmas * resolution_us / std::sqrt(12.0 * static_cast<double>(medians.size()));
  const double cut_off_us = resolution_us * resolution_us / (8 * measured.film_us);
  check.within("clock.rounded_by", sum_us / n, 0.5 * (resolution_us - 1), chance_us + cut_off_us,
               "us", 1);
  return check;
}

}  // namespace dodgesim
