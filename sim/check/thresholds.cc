#include "sim/check/thresholds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/normal_distribution.h"
#include "sim/check/film.h"
#include "sim/events/photoreceptor.h"
#include "sim/events/response.h"

namespace dodgesim {

namespace {

constexpr int kSlowRampWidth = 160, kSlowRampHeight = 120;
constexpr double kMostLog = 70;    // change of log luminance that a float can hold
constexpr double kThresholds = 6;  // mean thresholds that the ramp passes
constexpr double kSlowRampS = 20;  // of the ramp
constexpr TimeUs kSlowRampPictureEveryUs = 100000;
constexpr double kDarkLuminance = 0.01;  // above linear_below, where the ramp is darkest
constexpr double kSlowestHz = 1;         // the lag has settled well before the first event
constexpr double kStandardErrors = 3;
constexpr double kRelativeSlack = 2e-3;

double ramp_change(const EventCameraSpec& spec, double threshold) {
  return std::min(kMostLog, kThresholds * threshold + 8 * spec.mismatch_sigma);
}

// By how much a threshold may seem another because the photoreceptor lags less and less behind the
// brightening ramp, from the first event to the last.
double lag_change(const EventCameraSpec& spec, double threshold) {
  if (spec.photoreceptor_hz <= 0) return 0;
  const double change = ramp_change(spec, threshold);
  const Response response(spec.log_epsilon, spec.linear_below);
  const Photoreceptor photoreceptor(spec);
  const double dark = spec.linear_below + kDarkLuminance;
  const double bright = response.inverse(response.at(dark) + change);
  const double lag_s =
      1 / photoreceptor.cutoff_rad_s(dark) - 1 / photoreceptor.cutoff_rad_s(bright);
  return change / kSlowRampS * lag_s / (kThresholds - 2);
}

bool too_slow(const EventCameraSpec& spec) {
  const Photoreceptor photoreceptor(spec);
  const double dark_rad_s = photoreceptor.cutoff_rad_s(spec.linear_below + kDarkLuminance);
  return (photoreceptor.order() > 0 && dark_rad_s < 2 * std::numbers::pi * kSlowestHz) ||
         (spec.follower_hz > 0 && spec.follower_hz < kSlowestHz);
}

// The threshold of each pixel from the mean time between its first and its last event.
std::vector<double> ramp_thresholds(const EventCameraSpec& spec, std::uint64_t seed, bool up) {
  const double threshold = up ? spec.contrast_threshold_on : spec.contrast_threshold_off;
  const double change = ramp_change(spec, threshold);
  const double rate = change / kSlowRampS;
  const Response response(spec.log_epsilon, spec.linear_below);
  const double dark = response.at(spec.linear_below + kDarkLuminance);
  const Scene ramp = even_scene([&](TimeUs t_us) {
    const double risen = rate * seconds(t_us);
    return response.inverse(dark + (up ? risen : change - risen));
  });
  EventCamera camera(spec, kSlowRampWidth, kSlowRampHeight, seed, 0, "check", true);
  const auto end_us = static_cast<TimeUs>(1e6 * kSlowRampS);
  const auto events = record(camera, ramp, regular_times(kSlowRampPictureEveryUs, end_us)).events;

  struct Fired {
    TimeUs first_us = 0, last_us = 0;
    int count = 0;
  };
  std::vector<Fired> fired(static_cast<std::size_t>(kSlowRampWidth) * kSlowRampHeight);
  for (const Event& event : events) {
    if ((event.polarity > 0) != up) continue;
    Fired& pixel = fired[std::size_t{event.y} * kSlowRampWidth + event.x];
    if (pixel.count++ == 0) pixel.first_us = event.t_us;
    pixel.last_us = event.t_us;
  }
  std::vector<double> thresholds;
  for (const Fired& pixel : fired) {
    if (pixel.count < 2) continue;
    const double interval_s = seconds(pixel.last_us - pixel.first_us) / (pixel.count - 1);
    // While a pixel is held it does not see the ramp.
    thresholds.push_back(rate * (interval_s - seconds(spec.refractory_us)));
  }
  return thresholds;
}

Moments moments(const std::vector<double>& values) {
  double mean = 0, square = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (const double value : values) square += (value - mean) * (value - mean);
  return {mean, std::sqrt(square / std::max(1.0, static_cast<double>(values.size()) - 1))};
}

void judge_polarity(const std::string& name, const std::vector<double>& measured, int pixels,
                    double threshold, const EventCameraSpec& spec, Check& check) {
  if (spec.dead_pixel_fraction >= 1) {
    check.off("threshold." + name, "all pixels are dead");
    return;
  }
  if (too_slow(spec)) {
    check.off("threshold." + name, "the bandwidth is too low for a ramp of 20 s");
    return;
  }
  const Moments expected = clipped_normal(threshold, spec.mismatch_sigma, spec.threshold_min);
  const Moments found = moments(measured);
  const auto n = static_cast<double>(std::max<std::size_t>(1, measured.size()));
  const double slack = kRelativeSlack * threshold + lag_change(spec, threshold);
  check.within("threshold." + name + ".mean", found.mean, expected.mean,
               kStandardErrors * expected.sd / std::sqrt(n) + slack, "", 4);
  check.within("threshold." + name + ".sd", found.sd, expected.sd,
               kStandardErrors * expected.sd / std::sqrt(2 * n) + slack, "", 4);
  const double alive = pixels * (1 - spec.dead_pixel_fraction);
  const double dead_sd = std::sqrt(alive * spec.dead_pixel_fraction);
  check.within("threshold." + name + ".pixels", static_cast<double>(measured.size()), alive,
               kStandardErrors * dead_sd + (dead_sd > 0 ? 1 : 0), "", 0);
}

Series expected_curve(const std::string& name, int colour, double mean, double sd, double from,
                      double to, int bins) {
  Series curve{name, Series::Kind::kLine, colour};
  const double width = (to - from) / bins;
  for (int i = 0; sd > 0 && i < bins; ++i) {
    const double x = from + (i + 0.5) * width;
    curve.add(x, width / sd * normal_density((x - mean) / sd));
  }
  return curve;
}

}  // namespace

Moments clipped_normal(double mean, double sd, double lowest) {
  if (sd <= 0) return {std::max(mean, lowest), 0};
  const double a = (lowest - mean) / sd;
  const double below = normal_cdf(a);
  const double density = normal_density(a);
  const double first = lowest * below + mean * (1 - below) + sd * density;
  const double second = lowest * lowest * below + (mean * mean + sd * sd) * (1 - below) +
                        (mean + lowest) * sd * density;
  return {first, std::sqrt(std::max(0.0, second - first * first))};
}

MeasuredThresholds measure_thresholds(const EventCameraSpec& camera, std::uint64_t seed) {
  const EventCameraSpec spec = without_noise(camera);
  return {ramp_thresholds(spec, seed, true), ramp_thresholds(spec, seed, false),
          kSlowRampWidth * kSlowRampHeight};
}

Check judge(const MeasuredThresholds& measured, const EventCameraSpec& expected) {
  Check check{"Thresholds",
              "Log luminance rises slowly and evenly, then falls. A pixel's threshold is the "
              "ramp's slope times the mean time between its events. Mean and standard deviation "
              "over the pixels against the set ones (of a normal cut at threshold_min), within "
              "three standard errors and 0.2 %, and what a slow photoreceptor's lag changes by. "
              "Noise and jitter are off."};
  judge_polarity("on", measured.on, measured.pixels, expected.contrast_threshold_on, expected,
                 check);
  judge_polarity("off", measured.off, measured.pixels, expected.contrast_threshold_off, expected,
                 check);
  const double reach = std::max(5 * expected.mismatch_sigma, 0.1 * expected.contrast_threshold_on);
  const double from =
      std::min(expected.contrast_threshold_on, expected.contrast_threshold_off) - reach;
  const double to =
      std::max(expected.contrast_threshold_on, expected.contrast_threshold_off) + reach;
  constexpr int kBins = 61;
  Plot plot{"Measured contrast thresholds",
            {"threshold [log luminance]", from, to, false},
            {"share of the pixels", 0, 0, false},
            {histogram("ON", 0, measured.on, from, to, kBins),
             histogram("OFF", 1, measured.off, from, to, kBins)}};
  plot.series.push_back(expected_curve("set, ON", 0, expected.contrast_threshold_on,
                                       expected.mismatch_sigma, from, to, kBins));
  plot.series.push_back(expected_curve("set, OFF", 1, expected.contrast_threshold_off,
                                       expected.mismatch_sigma, from, to, kBins));
  check.plots.push_back(plot);
  return check;
}

}  // namespace dodgesim
