#include "sim/check/convergence.h"

#include <algorithm>
#include <cmath>

#include "sim/check/film.h"

namespace dodgesim {

namespace {

constexpr int kDriftWidth = 128, kDriftHeight = 96;
constexpr double kDriftPxps = 500;
constexpr double kFilmPx = 32;  // of motion
constexpr double kFiner = 8;    // the reference
// In units of the default displacement limit.
constexpr double kRates[] = {0.25, 0.5, 1, 2, 4, 8};

constexpr double kLeastMatched = 0.9;
constexpr double kLeastFilmed = 5000;

double default_displacement_px() { return SamplingSpec().max_displacement_px; }

std::vector<Event> film(const EventCameraSpec& spec, double displacement_px, std::uint64_t seed) {
  EventCamera camera(spec, kDriftWidth, kDriftHeight, seed, 0, "check", true);
  const DriftingTexture texture(kDriftWidth, kDriftHeight, kDriftPxps, seed);
  // The last instants are the same for all rates.
  const TimeUs step_us = std::llround(1e6 * displacement_px / kDriftPxps);
  const TimeUs end_us = std::llround(1e6 * kFilmPx / kDriftPxps);
  auto times = regular_times(step_us, end_us);
  times.push_back(end_us + spec.latency_us + 1);
  return record(
             camera,
             [&](TimeUs t_us, std::vector<float>& luminance) {
               texture(std::min(t_us, end_us), luminance);
             },
             times)
      .events;
}

}  // namespace

std::vector<Sampled> measure_convergence(const EventCameraSpec& camera, std::uint64_t seed) {
  const EventCameraSpec spec = without_noise(camera);
  const auto reference = film(spec, default_displacement_px() / kFiner, seed);
  std::vector<Sampled> rates;
  for (const double rate : kRates) {
    const double displacement_px = rate * default_displacement_px();
    rates.push_back({displacement_px, compare(film(spec, displacement_px, seed), reference)});
  }
  return rates;
}

Check judge(const std::vector<Sampled>& rates) {
  Check check{"Convergence",
              "A texture of waves of 8 px and more drifts at 500 px/s. Its events when it is "
              "sampled at several rates, against the same camera that sees it sampled eight times "
              "finer than by default. The limits hold for the default rate. Noise and jitter are "
              "off."};
  if (rates.front().difference.reference_events < kLeastFilmed) {
    check.off("convergence", "the film makes fewer than 5000 events");
    return check;
  }
  Series counts{"", Series::Kind::kPoints, 0};
  Series medians{"median", Series::Kind::kPoints, 0};
  Series tails{"90 % of the events", Series::Kind::kPoints, 1};
  for (const Sampled& rate : rates) {
    const std::string name = "convergence." + quantity_text(rate.displacement_px, 3, "") + "px";
    const EventDifference& d = rate.difference;
    counts.add(rate.displacement_px, 100 * (d.count_ratio - 1));
    medians.add(rate.displacement_px, d.median_us);
    tails.add(rate.displacement_px, d.percentile_90_us);
    if (rate.displacement_px > default_displacement_px()) continue;
    check.within(name + ".count", d.count_ratio, 1, kSamplingCountLimit, "of reference", 4);
    check.between(name + ".stamps", d.median_us, 0, kSamplingStampLimitUs, "us", 1);
    check.between(name + ".matched", d.matched, kLeastMatched, 1, "of events", 4);
  }
  check.plots.push_back({"Events more or less than the reference",
                         {"displacement from sample to sample [px]", 0.09, 5, true},
                         {"difference of the counts [%]", 0, 0, false},
                         {counts}});
  check.plots.push_back({"Distance of the time stamps from the reference",
                         {"displacement from sample to sample [px]", 0.09, 5, true},
                         {"[us]", 0, 0, true},
                         {medians, tails}});
  return check;
}

}  // namespace dodgesim
