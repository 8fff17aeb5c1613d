#include "sim/check/far_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "sim/base/random.h"
#include "sim/check/film.h"
#include "sim/events/event_camera.h"
#include "sim/events/light_between.h"

namespace dodgesim {

namespace {

constexpr int kFrameWidth = 40, kFrameHeight = 30;
constexpr TimeUs kIntervalsUs[] = {1000, 33333};
constexpr int kFrames = 4;
constexpr TimeUs kRestUs = 500000;  // after the last frame, for slow pixels
constexpr double kDarkest = -4.5;   // ln of the light, which is at most 1
constexpr std::int64_t kFineSteps = 500;
constexpr double kLeastOfFrames = 500;
// Least cut-off times step that single precision follows (spec.h).
constexpr double kLeastTurns = 2e-6;

// By how much more a low-pass may be early. A step has the cut-off of the mean of the lights at its
// ends; along a straight line of the response the light's own mean is less, here by 0.28 %. So
// early is the low-pass while it is on its way.
double early_us(const EventCameraSpec& spec, TimeUs interval_us) {
  constexpr double kChange = LightBetween::kChange;
  constexpr double kTimeConstants = 3;  // leave 5 % of a step
  const double share = (1 + kChange) / 2 * std::log(kChange) / (kChange - 1) - 1;
  const double lag_us = 1e6 * kTimeConstants / (2 * std::numbers::pi * slowest_hz(spec));
  return share * std::min(lag_us, static_cast<double>(interval_us));
}

// Any light between the darkest and 1, for each pixel of each frame.
std::vector<float> random_frame(int number, std::uint64_t seed) {
  const RandomStream light(seed, static_cast<std::uint64_t>(number), "far frames");
  std::vector<float> frame(static_cast<std::size_t>(kFrameWidth) * kFrameHeight);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    frame[i] = static_cast<float>(std::exp(kDarkest * unit_interval(light.block(i)[0])));
  }
  return frame;
}

// fine_steps: how many steps there are from frame to frame; 0: as many as light_between.h says.
std::vector<Event> film(const EventCameraSpec& spec, TimeUs interval_us, std::int64_t fine_steps,
                        std::uint64_t seed) {
  EventCamera camera(spec, kFrameWidth, kFrameHeight, seed, 0, "check");
  LightBetween light(spec);
  std::vector<float> before = random_frame(0, seed);
  std::vector<Event> events;
  camera.reset(0, before.data());
  TimeUs t_us = 0;
  for (int i = 1; i < kFrames; ++i, t_us += interval_us) {
    const std::vector<float> after = random_frame(i, seed);
    const std::int64_t steps =
        fine_steps > 0 ? fine_steps : light.steps(interval_us, before, after);
    light.show_between(
        steps, t_us, before, t_us + interval_us, after,
        [&](TimeUs at_us, const auto& seen) { camera.update(at_us, seen.data(), events); });
    camera.update(t_us + interval_us, after.data(), events);
    before = after;
  }
  camera.update(t_us + kRestUs, before.data(), events);
  return events;
}

}  // namespace

std::vector<FarFrames> measure_far_frames(const EventCameraSpec& camera, std::uint64_t seed) {
  const EventCameraSpec spec = without_noise(camera);
  std::vector<FarFrames> intervals;
  for (const TimeUs interval_us : kIntervalsUs) {
    if (slowest_hz(spec) * seconds(interval_us) / kFineSteps < kLeastTurns) {
      intervals.push_back({interval_us, {}, true});
      continue;
    }
    const auto reference = film(spec, interval_us, kFineSteps, seed);
    intervals.push_back({interval_us, compare(film(spec, interval_us, 0, seed), reference), false,
                         early_us(spec, interval_us)});
  }
  return intervals;
}

Check judge(const std::vector<FarFrames>& intervals) {
  Check check{"Frames far apart",
              "Four frames of random light, from 0.011 to 1 in each pixel, as far apart as those "
              "of a fast camera and of a video. The events of dodgesim emulate, against the same "
              "camera that sees 500 pictures from frame to frame, along the same straight line of "
              "the response. Noise and jitter are off."};
  for (const FarFrames& frames : intervals) {
    const std::string name = "frames." + std::to_string(frames.interval_us) + "us";
    const EventDifference& d = frames.difference;
    if (frames.too_slow) {
      check.off(name, "in steps as fine as the reference's so slow a low-pass rests too early");
      continue;
    }
    if (d.reference_events < kLeastOfFrames) {
      check.off(name, "the film makes fewer than 500 events");
      continue;
    }
    check.within(name + ".count", d.count_ratio, 1, kSamplingCountLimit, "of reference", 4);
    check.between(name + ".stamps", d.median_us, 0, kSamplingStampLimitUs + frames.early_us, "us",
                  1);
  }
  return check;
}

}  // namespace dodgesim
