#include "sim/check/stamps.h"

#include <algorithm>

#include "sim/check/film.h"

namespace dodgesim {

namespace {

constexpr int kTextureWidth = 160, kTextureHeight = 120;
constexpr double kTexturePxps = 500;
constexpr TimeUs kSampleUs = 1000;  // half a pixel of motion
constexpr TimeUs kDurationUs = 100000;
constexpr TimeUs kFirstPicturesUs = 20000;  // their events are left out

constexpr double kNear = 0.05;        // of a sample, as a share of the interval
constexpr double kShareSlack = 0.02;  // about the even share of 2 kNear
constexpr int kBins = 20;
constexpr double kMostOfEven = 1.25;        // of a bin
constexpr std::size_t kLeastStamps = 5000;  // with fewer, bins vary so much by chance

}  // namespace

StampPhases measure_stamps(const EventCameraSpec& camera_spec, std::uint64_t seed) {
  const EventCameraSpec spec = without_noise(camera_spec);
  EventCamera camera(spec, kTextureWidth, kTextureHeight, seed, 0, "check", true);
  const DriftingTexture texture(kTextureWidth, kTextureHeight, kTexturePxps, seed);
  const auto events =
      record(camera, texture, regular_times(kSampleUs, kDurationUs + spec.latency_us)).events;
  StampPhases measured;
  for (const Event& event : events) {
    const TimeUs changed_us = event.t_us - spec.latency_us;
    if (changed_us < kFirstPicturesUs) continue;
    // Stamps are rounded: the microsecond's middle is where its events are on average.
    measured.phases.push_back((static_cast<double>(changed_us % kSampleUs) + 0.5) / kSampleUs);
  }
  return measured;
}

Check judge(const StampPhases& measured) {
  Check check{"Time stamps",
              "A texture drifts by half a pixel from sample to sample, 1 ms apart. Stamps, less "
              "the latency, must be spread evenly between the samples: of all events as many "
              "within 5 % of the interval about a sample as elsewhere, and none of twenty bins "
              "more than a quarter above the even share. Noise and jitter are off."};
  const auto& phases = measured.phases;
  if (phases.size() < kLeastStamps) {
    check.off("stamps", "the film makes fewer than 5000 events");
    return check;
  }
  const auto n = static_cast<double>(phases.size());
  const auto near = std::ranges::count_if(
      phases, [](double phase) { return phase < kNear || phase >= 1 - kNear; });
  check.within("stamps.at_samples", 100 * static_cast<double>(near) / n, 200 * kNear,
               100 * kShareSlack, "%", 2);
  const Series bars = histogram("", 0, phases, 0, 1, kBins);
  const double highest = *std::ranges::max_element(bars.y) * kBins;
  const double lowest = *std::ranges::min_element(bars.y) * kBins;
  check.between("stamps.fullest_bin", highest, 1, kMostOfEven, "of even", 3);
  check.between("stamps.emptiest_bin", lowest, 2 - kMostOfEven, 1, "of even", 3);
  check.plots.push_back({"Time stamps between two samples of the light",
                         {"time since the last sample / interval", 0, 1, false},
                         {"share of the events", 0, 3.0 / kBins, false},
                         {bars}});
  return check;
}

}  // namespace dodgesim
