// A plain event camera for one pixel at a time, written from the definition and without regard to
// speed, against which the real one is held.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

#include "sim/events/event.h"
#include "sim/events/event_camera.h"

namespace dodgesim::testing {

struct Frame {
  TimeUs t_us = 0;
  std::vector<float> luminance;
};

using Frames = std::vector<Frame>;

// width x height pictures of luminance(x, y, t_us) at the given instants.
inline Frames film(int width, int height, const std::vector<TimeUs>& times,
                   const std::function<double(int, int, TimeUs)>& luminance) {
  Frames frames;
  for (const TimeUs t : times) {
    Frame frame{t, {}};
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        frame.luminance.push_back(static_cast<float>(luminance(x, y, t)));
      }
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

inline std::vector<TimeUs> every(TimeUs step, TimeUs end) {
  std::vector<TimeUs> times;
  for (TimeUs t = 0; t <= end; t += step) times.push_back(t);
  return times;
}

inline std::vector<Event> emulate(EventCamera& camera, const Frames& frames) {
  std::vector<Event> events;
  camera.reset(frames.front().t_us, frames.front().luminance.data());
  for (std::size_t i = 1; i < frames.size(); ++i) {
    camera.update(frames[i].t_us, frames[i].luminance.data(), events);
  }
  return events;
}

inline bool event_order(const Event& a, const Event& b) {
  return std::tie(a.t_us, a.y, a.x, a.polarity) < std::tie(b.t_us, b.y, b.x, b.polarity);
}

// The events of all pixels in order, with exact (not rounded) times beside them.
struct ReferenceEvent {
  double t_us;
  Event event;
};

inline std::vector<ReferenceEvent> reference_events(const EventCamera& camera, const Frames& frames,
                                                    double log_epsilon, double refractory_us) {
  std::vector<ReferenceEvent> events;
  for (int y = 0; y < camera.height(); ++y) {
    for (int x = 0; x < camera.width(); ++x) {
      const PixelState pixel = camera.pixel(x, y);
      const auto index = static_cast<std::size_t>(y * camera.width() + x);
      const auto value = [&](std::size_t i) {
        return std::log(log_epsilon + static_cast<double>(frames[i].luminance[index]));
      };
      double reference = value(0);
      double now = static_cast<double>(frames.front().t_us);  // the pixel is settled up to here
      bool held = false;  // if so, now is the end of the refractory period
      for (std::size_t i = 1; i < frames.size(); ++i) {
        const auto t0 = static_cast<double>(frames[i - 1].t_us);
        const auto t1 = static_cast<double>(frames[i].t_us);
        const double slope = (value(i) - value(i - 1)) / (t1 - t0);
        while (now <= t1) {
          if (held) {
            reference = value(i - 1) + slope * (now - t0);
            held = false;
          }
          const double change = slope > 0 ? pixel.threshold_on : -pixel.threshold_off;
          const double crossing = t0 + (reference + change - value(i - 1)) / slope;
          if (slope == 0 ||
              (slope > 0 ? value(i) < reference + change : value(i) > reference + change)) {
            now = t1;
            break;
          }
          events.push_back(
              {crossing,
               {static_cast<TimeUs>(std::lround(crossing)), static_cast<std::uint16_t>(x),
                static_cast<std::uint16_t>(y), static_cast<std::int8_t>(slope > 0 ? 1 : -1)}});
          reference += change;
          now = crossing;
          if (refractory_us > 0) {
            now = crossing + refractory_us;
            held = true;
          }
        }
      }
    }
  }
  std::sort(events.begin(), events.end(),
            [](const auto& a, const auto& b) { return event_order(a.event, b.event); });
  return events;
}

}  // namespace dodgesim::testing
