#include "sim/check/step_response.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "sim/base/normal_distribution.h"
#include "sim/check/film.h"
#include "sim/check/quantile.h"

namespace dodgesim {

namespace {

constexpr int kStepWidth = 80, kStepHeight = 60;
constexpr double kStep = 2;  // up or down, of the luminance
constexpr double kLevelsLux[] = {1, 10, 100, 1000, 10000};
constexpr TimeUs kBeforeStepUs = 1000;
constexpr double kFilmS = 0.5;      // after the step
constexpr int kStepPictures = 400;  // ever farther apart

constexpr double kStepRelativeLimit = 0.02;
constexpr double kAbsoluteLimitUs = 2;  // stamps are rounded to 1 us, and a step takes 1 us
constexpr double kSpreadLimit = 0.01;
constexpr double kSpreadSigma = 1;  // the same for the spread as kMedianSigma for the median
constexpr double kStepSigmas = 3;
constexpr double kLowest = 0.16, kHighest = 0.84;  // quantiles: a standard deviation about the mean

// Of these 203, 0.16, 0.5 and 0.84 are in the middle of one.
constexpr int kThresholdQuantiles = 400, kJitterQuantiles = 203;

// ln(eps + I), or the tangent where I < linear_below. Written again, independent of the camera.
double response(const EventCameraSpec& spec, double luminance) {
  const double knee = spec.log_epsilon + spec.linear_below;
  if (luminance >= spec.linear_below) return std::log(spec.log_epsilon + luminance);
  return std::log(knee) + (luminance - spec.linear_below) / knee;
}

// Of the response; positive in either direction.
double height_of(const LightStep& step, const EventCameraSpec& spec) {
  return std::abs(response(spec, step.after_lux / spec.illuminance_lux) -
                  response(spec, step.before_lux / spec.illuminance_lux));
}

double threshold_for(const LightStep& step, const EventCameraSpec& spec) {
  return step.up() ? spec.contrast_threshold_on : spec.contrast_threshold_off;
}

double spread(const std::vector<double>& values) {
  return 0.5 * (quantile(values, kHighest) - quantile(values, kLowest));
}

int jitter_quantiles(const EventCameraSpec& spec) {
  return spec.jitter_us > 0 ? kJitterQuantiles : 1;
}

// The pixel's latency with equally likely jitters.
std::vector<double> pixel_latencies_us(const EventCameraSpec& spec) {
  std::vector<double> latencies_us;
  const int count = jitter_quantiles(spec);
  for (int i = 0; i < count; ++i) {
    const double jitter_us = spec.jitter_us * normal_quantile((i + 0.5) / count);
    latencies_us.push_back(std::max(0.0, static_cast<double>(spec.latency_us) + jitter_us));
  }
  return latencies_us;
}

// Latencies of equally likely pixels: of their thresholds, and of the jitter.
std::vector<double> expected_latencies_us(const EventCameraSpec& spec, const LightStep& step) {
  const double a =
      spec.photoreceptor_hz > 0
          ? 2 * std::numbers::pi *
                (spec.photoreceptor_dark_hz + spec.photoreceptor_hz * step.after_lux / kBrightLux)
          : 0;
  const double b = 2 * std::numbers::pi * spec.follower_hz;
  const double height = height_of(step, spec);
  const std::vector<double> pixels_us = pixel_latencies_us(spec);
  std::vector<double> latencies;
  for (int i = 0; i < kThresholdQuantiles; ++i) {
    const double normal = normal_quantile((i + 0.5) / kThresholdQuantiles);
    const double threshold =
        std::max(spec.threshold_min, threshold_for(step, spec) + spec.mismatch_sigma * normal);
    const double late_us = 1e6 * step_time_s(threshold / height, a, b);
    if (!std::isfinite(late_us) || late_us > 1e6 * kFilmS) continue;
    for (const double pixel_us : pixels_us) latencies.push_back(late_us + pixel_us);
  }
  return latencies;
}

bool applies(const EventCameraSpec& spec, const LightStep& step) {
  return height_of(step, spec) > threshold_for(step, spec) + 3 * spec.mismatch_sigma;
}

StepAnswer measure(const EventCameraSpec& spec, const LightStep& step, std::uint64_t seed) {
  EventCamera camera(spec, kStepWidth, kStepHeight, seed, 0, "check", true);
  const Scene scene = even_scene([&](TimeUs t_us) {
    return (t_us > kBeforeStepUs ? step.after_lux : step.before_lux) / spec.illuminance_lux;
  });
  std::vector<TimeUs> times = {0, kBeforeStepUs};
  const double longest_us = 1e6 * kFilmS;
  for (int i = 0; i <= kStepPictures; ++i) {
    const double later_us = std::pow(longest_us, static_cast<double>(i) / kStepPictures);
    times.push_back(std::max(times.back() + 1, kBeforeStepUs + static_cast<TimeUs>(later_us)));
  }
  StepAnswer answer{step};
  std::vector<bool> seen(static_cast<std::size_t>(kStepWidth) * kStepHeight);
  for (const Event& event : record(camera, scene, times).events) {
    const auto pixel = std::size_t{event.y} * kStepWidth + event.x;
    if ((event.polarity > 0) != step.up() || seen[pixel]) continue;
    seen[pixel] = true;
    answer.latencies_us.push_back(static_cast<double>(event.t_us - kBeforeStepUs));
  }
  return answer;
}

// Why nothing can be said of a step; empty if something can.
std::string why_not(const EventCameraSpec& spec, const LightStep& step,
                    const std::vector<double>& late_us) {
  if (!applies(spec, step)) return "the step is below some thresholds";
  if (spec.dead_pixel_fraction >= 1) return "all pixels are dead";
  const std::size_t all =
      std::size_t{kThresholdQuantiles} * static_cast<std::size_t>(jitter_quantiles(spec));
  return late_us.size() < all / 2 ? "most pixels are slower than the film" : "";
}

// Adds a step's checks, and its point to the plot.
void judge_step(const StepAnswer& answer, const EventCameraSpec& expected, Check& check,
                Series& measured) {
  const LightStep& step = answer.step;
  const std::string name = std::string(step.up() ? "step.up." : "step.down.") +
                           quantity_text(step.before_lux, 0, "") + "_lux";
  const auto expected_us = expected_latencies_us(expected, step);
  if (const std::string why = why_not(expected, step, expected_us); !why.empty()) {
    return check.off(name, why);
  }
  const double median_us = quantile(answer.latencies_us, 0.5);
  const double expected_median_us = quantile(expected_us, 0.5);
  const double spread_us = spread(expected_us);
  const auto count = static_cast<double>(std::max<std::size_t>(1, answer.latencies_us.size()));
  const double sigma = kStepSigmas / std::sqrt(count);
  // Where jitter would come before the light, half of its distribution lies at one point, and what
  // is left spreads by less than its standard deviation.
  const double chance_us = sigma * std::max(spread_us, expected.jitter_us);
  const double late_us =
      std::max(0.0, expected_median_us - static_cast<double>(expected.latency_us));
  check.within(name + ".median", median_us, expected_median_us,
               kStepRelativeLimit * late_us + kAbsoluteLimitUs + kMedianSigma * chance_us, "us", 1);
  check.within(name + ".spread", spread(answer.latencies_us), spread_us,
               kSpreadLimit * spread_us + kAbsoluteLimitUs + kSpreadSigma * chance_us, "us", 1);
  measured.add(step.before_lux, median_us);
  measured.spread.push_back(spread(answer.latencies_us));
}

Series closed_form(const EventCameraSpec& expected, bool up) {
  Series curve{up ? "up, closed form" : "down, closed form", Series::Kind::kLine, up ? 1 : 3};
  constexpr int kPoints = 50;
  for (int i = 0; i < kPoints; ++i) {
    const double lux = std::pow(10, 4.0 * i / (kPoints - 1));  // 1 to 10000
    const LightStep step{lux, up ? kStep * lux : lux / kStep};
    if (!applies(expected, step)) continue;
    curve.add(lux, quantile(expected_latencies_us(expected, step), 0.5));
  }
  return curve;
}

}  // namespace

double step_time_s(double share, double a, double b) {
  if (share >= 1) return INFINITY;
  if (a <= 0 && b <= 0) return 0;
  if (a <= 0 || b <= 0) return -std::log1p(-share) / std::max(a, b);
  const auto reached = [&](double t_s) {
    if (std::abs(a - b) < 1e-6 * a) return 1 - (1 + a * t_s) * std::exp(-a * t_s);
    return 1 - (b * std::exp(-a * t_s) - a * std::exp(-b * t_s)) / (b - a);
  };
  double low = 0, high = 1 / std::min(a, b);
  while (reached(high) < share) high *= 2;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (reached(middle) < share ? low : high) = middle;
  }
  return high;
}

std::vector<StepAnswer> measure_step_response(const EventCameraSpec& camera, std::uint64_t seed) {
  EventCameraSpec spec = without_noise(camera);
  spec.jitter_us = camera.jitter_us;
  // One event of each pixel: of several, the jitter would decide which comes first.
  spec.refractory_us = static_cast<TimeUs>(2e6 * kFilmS);
  std::vector<StepAnswer> answers;
  for (const double factor : {kStep, 1 / kStep}) {
    for (const double lux : kLevelsLux) {
      answers.push_back(measure(spec, {lux, factor * lux}, seed));
    }
  }
  return answers;
}

Check judge(const std::vector<StepAnswer>& answers, const EventCameraSpec& expected) {
  Check check{
      "Step response",
      "The light doubles or halves at once, at several levels. The first ON or OFF events come "
      "after the pixel's latency and the time that its bandwidth, which is that of the new light, "
      "takes to pass the threshold: for one low-pass -tau ln(1 - C/step). Median and spread "
      "(half of what lies between the quantiles 0.16 and 0.84: mismatch and jitter) "
      "against that closed form, to 2 % without the latency and three standard deviations of "
      "the median. Noise, the readout's limit and further events are off."};
  Plot plot{"First event after the light has doubled or halved",
            {"illuminance before the step [lux]", 0.7, 15000, true},
            {"latency [us]", 0, 0, false},
            {}};
  for (const bool up : {true, false}) {
    const std::string name = up ? "up" : "down";
    Series measured{name + ", measured, with spread", Series::Kind::kPoints, up ? 0 : 2};
    for (const StepAnswer& answer : answers) {
      if (answer.step.up() == up) judge_step(answer, expected, check, measured);
    }
    plot.series.push_back(closed_form(expected, up));
    plot.series.push_back(measured);
  }
  check.plots.push_back(plot);
  return check;
}

}  // namespace dodgesim
