// A textured wall seen by a moving camera, evaluated in closed form at the pixel centres.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sim/camera/looking_forward.h"
#include "sim/events/event_camera.h"
#include "sim/events/sampler.h"
#include "sim/world/snapshot.h"

namespace dodgesim::testing {

// The wall is the plane x = wall_x of W; the vehicle is its camera (B = C at the same place), which
// looks along +x at t = 0 and moves with constant v_W and w_W.
struct MovingPlane {
  Intrinsics intrinsics{96, 72, 190.68};
  double wall_x = 2;
  double wavelength_px = 7;  // of the finest component, seen from the start
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_W = Eigen::Vector3d::Zero();

  // C in B: z forward, x right, y down.
  static Eigen::Isometry3d X_BC() {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = looking_forward();
    return X;
  }

  Snapshot snapshot(TimeUs t_us) const {
    Snapshot s;
    s.t_us = t_us;
    s.vehicle.v_W = v_W;
    s.vehicle.w_W = w_W;
    s.vehicle.p_W = v_W * seconds(t_us);
    const double angle = w_W.norm() * seconds(t_us);
    if (angle > 0) s.vehicle.q_W = Eigen::AngleAxisd(angle, w_W.normalized());
    return s;
  }

  double texture(double y, double z) const {
    const double k = 2 * M_PI * intrinsics.f / (wall_x * wavelength_px);
    return 0.55 + 0.2 * std::sin(k * (0.8 * y + 0.6 * z)) +
           0.15 * std::sin(0.53 * k * (0.5 * y - 0.86 * z) + 1) +
           0.15 * std::sin(0.21 * k * (0.94 * y + 0.34 * z) + 2);
  }

  void render(TimeUs t_us, std::vector<float>& picture) const {
    const Eigen::Isometry3d X_WC = snapshot(t_us).vehicle.pose() * X_BC();
    picture.clear();
    for (int v = 0; v < intrinsics.height; ++v) {
      for (int u = 0; u < intrinsics.width; ++u) {
        const Eigen::Vector3d ray =
            X_WC.linear() * Eigen::Vector3d((u - intrinsics.cx()) / intrinsics.f,
                                            (v - intrinsics.cy()) / intrinsics.f, 1);
        const Eigen::Vector3d hit =
            X_WC.translation() + ray * ((wall_x - X_WC.translation().x()) / ray.x());
        picture.push_back(static_cast<float>(texture(hit.y(), hit.z())));
      }
    }
  }
};

// The instants at which the sampler wants the wall to be seen in (0, end_us].
inline std::vector<TimeUs> sample_times(const MovingPlane& plane, const SamplingSpec& spec,
                                        double nearest_m, TimeUs end_us) {
  Sampler sampler(spec, plane.intrinsics, MovingPlane::X_BC(), {});
  sampler.reset(0);
  std::vector<Sample> samples;
  for (TimeUs t = 0; t < end_us; t += kTickUs) {
    sampler.advance(plane.snapshot(t), plane.snapshot(t + kTickUs), StaticDistances(nearest_m),
                    samples);
  }
  std::vector<TimeUs> times;
  times.reserve(samples.size());
  for (const Sample& sample : samples) times.push_back(sample.t_us);
  return times;
}

// Each interval of `times` divided into `parts`.
inline std::vector<TimeUs> subdivide(const std::vector<TimeUs>& times, int parts) {
  std::vector<TimeUs> out;
  TimeUs previous = 0;
  for (const TimeUs t : times) {
    for (int i = 1; i <= parts; ++i) {
      const TimeUs s = previous + (t - previous) * i / parts;
      if (out.empty() || s > out.back()) out.push_back(s);
    }
    previous = t;
  }
  return out;
}

inline std::vector<Event> events_of(const MovingPlane& plane, const EventCameraSpec& spec,
                                    const std::vector<TimeUs>& times) {
  EventCamera camera(spec, plane.intrinsics.width, plane.intrinsics.height, 1, 0, "top");
  std::vector<float> picture;
  std::vector<Event> events;
  plane.render(0, picture);
  camera.reset(0, picture.data());
  for (const TimeUs t : times) {
    plane.render(t, picture);
    camera.update(t, picture.data(), events);
  }
  return events;
}

// How two event streams of the same scene differ.
struct Difference {
  double count = 0;      // relative difference of the numbers of events
  double matched = 0;    // share of events in pixels with the same sequence of polarities
  double median_us = 0;  // of the stamps of matched events
  double p90_us = 0;
};

inline Difference compare(const std::vector<Event>& coarse, const std::vector<Event>& fine) {
  using Stream = std::map<std::pair<int, int>, std::vector<Event>>;
  const auto split = [](const std::vector<Event>& events) {
    Stream stream;
    for (const Event& event : events) stream[{event.y, event.x}].push_back(event);
    return stream;
  };
  const Stream a = split(coarse);
  const Stream b = split(fine);
  std::vector<double> delays;
  for (const auto& [pixel, events] : b) {
    const auto other = a.find(pixel);
    if (other == a.end() || other->second.size() != events.size()) continue;
    const bool same =
        std::equal(events.begin(), events.end(), other->second.begin(),
                   [](const Event& l, const Event& r) { return l.polarity == r.polarity; });
    if (!same) continue;
    for (std::size_t i = 0; i < events.size(); ++i) {
      delays.push_back(std::abs(static_cast<double>(events[i].t_us - other->second[i].t_us)));
    }
  }
  std::sort(delays.begin(), delays.end());
  Difference d;
  d.count = (static_cast<double>(coarse.size()) - static_cast<double>(fine.size())) /
            static_cast<double>(fine.size());
  d.matched = static_cast<double>(delays.size()) / static_cast<double>(fine.size());
  if (!delays.empty()) {
    d.median_us = delays[delays.size() / 2];
    d.p90_us = delays[delays.size() * 9 / 10];
  }
  return d;
}

}  // namespace dodgesim::testing
