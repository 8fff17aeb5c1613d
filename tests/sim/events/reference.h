// A plain event camera for one pixel at a time, written from the definition and without regard to
// speed, against which the real one is held.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/events/event.h"
#include "sim/events/event_camera.h"

namespace dodgesim::testing {

struct Frame {
  TimeUs t_us = 0;
  std::vector<float> luminance;
  std::optional<Rect> region = std::nullopt;  // if set, only these pixels are sampled

  bool shows(int x, int y) const {
    return !region || (x >= region->x0 && x < region->x1 && y >= region->y0 && y < region->y1);
  }
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
    const Frame& frame = frames[i];
    if (frame.region) {
      camera.add_region(frame.t_us, *frame.region, frame.luminance.data());
    } else {
      camera.update(frame.t_us, frame.luminance.data(), events);
    }
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
      const auto index = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width()) +
                         static_cast<std::size_t>(x);
      std::vector<const Frame*> samples;  // of this pixel
      for (const Frame& frame : frames) {
        if (frame.shows(x, y)) samples.push_back(&frame);
      }
      const auto value = [&](std::size_t i) {
        return std::log(log_epsilon + static_cast<double>(samples[i]->luminance[index]));
      };
      double reference = value(0);
      double now = static_cast<double>(samples.front()->t_us);  // the pixel is settled up to here
      bool held = false;  // if so, now is the end of the refractory period
      for (std::size_t i = 1; i < samples.size(); ++i) {
        const auto t0 = static_cast<double>(samples[i - 1]->t_us);
        const auto t1 = static_cast<double>(samples[i]->t_us);
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

// Pixel by pixel, because two pixels may swap places when their stamps round differently.
inline void expect_same(const std::vector<Event>& events,
                        const std::vector<ReferenceEvent>& expected) {
  ASSERT_EQ(events.size(), expected.size());
  std::map<std::pair<int, int>, std::vector<Event>> by_pixel;
  for (const Event& event : events) by_pixel[{event.x, event.y}].push_back(event);
  std::map<std::pair<int, int>, std::size_t> next;
  for (const auto& [t_us, event] : expected) {
    const auto& stream = by_pixel[{event.x, event.y}];
    const std::size_t i = next[{event.x, event.y}]++;
    ASSERT_LT(i, stream.size());
    EXPECT_EQ(stream[i].polarity, event.polarity);
    // Rounded to the microsecond; at the start of an interval pushed into it.
    EXPECT_LE(std::abs(static_cast<double>(stream[i].t_us) - t_us), 1 + 1e-6);
  }
}

// Nobody is to be stuck beyond a threshold. Returns how many of the pixels are not held.
inline int expect_within_thresholds(const EventCamera& camera) {
  int armed = 0;
  for (int y = 0; y < camera.height(); ++y) {
    for (int x = 0; x < camera.width(); ++x) {
      const PixelState p = camera.pixel(x, y);
      if (p.held) continue;
      ++armed;
      EXPECT_LT(p.signal - p.reference, p.threshold_on);
      EXPECT_GT(p.signal - p.reference, -p.threshold_off);
    }
  }
  return armed;
}

// Every pixel that lives has had an event after this instant.
inline void expect_events_of_all_after(TimeUs t_us, const EventCamera& camera,
                                       const std::vector<Event>& events) {
  std::map<std::pair<int, int>, TimeUs> last_us;
  for (const Event& event : events) last_us[{event.x, event.y}] = event.t_us;
  for (int y = 0; y < camera.height(); ++y) {
    for (int x = 0; x < camera.width(); ++x) {
      if (std::isinf(camera.pixel(x, y).threshold_on)) continue;
      EXPECT_GT((last_us[{x, y}]), t_us) << x << ", " << y;
    }
  }
}

}  // namespace dodgesim::testing
