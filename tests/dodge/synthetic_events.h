// Event streams with a known truth, for the tests of the flight core: disks (thrown balls, and
// spots of a far background) with geometry in closed form, seen by a moving pinhole camera, plus
// noise.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "dodge/camera_model.h"
#include "dodge/types.h"
#include "sim/base/random.h"
#include "tests/exponential.h"

namespace dodge::synthetic {

// A sphere, drawn as a disk that changes the log luminance by log_contrast.
struct Disk {
  std::function<Eigen::Vector3d(double t_s)> p_W;
  double radius_m = 0.1;
  double log_contrast = 1;
};

using Motion = std::function<Eigen::Isometry3d(double t_s)>;  // X_WB

struct Sensor {
  double contrast_threshold = 0.25;
  double threshold_sigma = 0.03;  // fixed mismatch of the pixels
  double noise_hz = 0.44;         // background activity per pixel
  double hot_fraction = 0;        // of the pixels ...
  double hot_hz = 0;              // ... that fire at this rate instead
};

// R_BC of a camera that looks along +x of B: C's x is right, y down, z forward.
inline Eigen::Matrix3d forward_camera() {
  Eigen::Matrix3d R_BC;
  R_BC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return R_BC;
}

// The paper's vertical pair, 15 cm apart, the upper one first.
inline std::vector<CameraModel> vertical_pair() {
  std::vector<CameraModel> cameras(2);
  for (std::size_t i = 0; i < 2; ++i) {
    cameras[i].X_BC.linear() = forward_camera();
    cameras[i].X_BC.translation() = Eigen::Vector3d(0.1, 0, i == 0 ? 0.075 : -0.075);
  }
  return cameras;
}

// A throw from p_W that passes the point aim_W (gravity included) with the mean horizontal speed.
inline Disk thrown_ball(const Eigen::Vector3d& from_W, const Eigen::Vector3d& aim_W,
                        double speed_mps, double diameter_m, double log_contrast,
                        double start_s = 0) {
  const Eigen::Vector3d g(0, 0, -9.81);
  const double flight_s = (aim_W - from_W).head<2>().norm() / speed_mps;
  const Eigen::Vector3d v = (aim_W - from_W) / flight_s - 0.5 * g * flight_s;
  return {[=](double t_s) {
            const double t = t_s - start_s;
            return Eigen::Vector3d(from_W + v * t + 0.5 * g * t * t);
          },
          0.5 * diameter_m, log_contrast};
}

// Round spots of a background far away, spread over the directions around +x_W.
inline std::vector<Disk> far_background(int count, std::uint64_t seed,
                                        double half_angle_rad = 0.8) {
  dodgesim::RandomStream random(seed, 0, "background");
  std::vector<Disk> disks;
  for (int i = 0; i < count; ++i) {
    const double distance_m = 1000;
    const double azimuth = random.uniform(-half_angle_rad, half_angle_rad);
    const double elevation = random.uniform(-0.75 * half_angle_rad, 0.75 * half_angle_rad);
    const Eigen::Vector3d p_W(distance_m, -distance_m * std::tan(azimuth),
                              distance_m * std::tan(elevation));
    const double radius_m = distance_m * random.uniform(0.02, 0.08);
    const double contrast = random.uniform(0.4, 1.2) * (random.uniform() < 0.5 ? -1 : 1);
    disks.push_back({[p_W](double) { return Eigen::Vector3d(p_W); }, radius_m, contrast});
  }
  return disks;
}

// Events of one camera in (begin, end] of whole microseconds. The log luminance is the sum over the
// disks of contrast times coverage (an edge one pixel wide), followed in steps of step_us; every
// crossing of a threshold is an event at its interpolated time.
class EventGenerator {
 public:
  EventGenerator(const CameraModel& camera, const Motion& motion, std::vector<Disk> disks,
                 const Sensor& sensor, std::uint64_t seed, std::uint64_t camera_index,
                 TimeUs begin_us = 0)
      : camera_(camera),
        motion_(motion),
        disks_(std::move(disks)),
        sensor_(sensor),
        random_(seed, camera_index, "noise"),
        t_us_(begin_us) {
    const auto size =
        static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    level_.assign(size, 0);
    reference_.assign(size, 0);
    circles_.resize(disks_.size());
    dodgesim::RandomStream mismatch(seed, camera_index, "mismatch");
    for (std::size_t i = 0; i < size; ++i) {
      threshold_.push_back(static_cast<float>(
          std::max(0.05, sensor.contrast_threshold + sensor.threshold_sigma * mismatch.normal())));
      if (mismatch.uniform() < sensor.hot_fraction) hot_.push_back(static_cast<int>(i));
    }
    for (std::size_t k = 0; k < disks_.size(); ++k) circles_[k] = circle(disks_[k], t_us_);
  }

  void advance(TimeUs end_us, std::vector<Event>& out, TimeUs step_us = 250) {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    const TimeUs begin_us = t_us_;
    while (t_us_ < end_us) step(std::min(t_us_ + step_us, end_us), out);
    const double rate_hz = sensor_.noise_hz * static_cast<double>(level_.size());
    add_noise(begin_us, end_us, rate_hz, nullptr, out);
    if (!hot_.empty()) {
      add_noise(begin_us, end_us, sensor_.hot_hz * static_cast<double>(hot_.size()), &hot_, out);
    }
    std::sort(out.begin() + first, out.end(), [](const Event& a, const Event& b) {
      return std::tie(a.t_us, a.y, a.x, a.polarity) < std::tie(b.t_us, b.y, b.x, b.polarity);
    });
  }

 private:
  struct Circle {
    double x = 0, y = 0, radius = -1;  // [px]; radius < 0: not in front of the camera
  };

  Circle circle(const Disk& disk, TimeUs t_us) const {
    const double t_s = 1e-6 * static_cast<double>(t_us);
    const Eigen::Vector3d p_C = (motion_(t_s) * camera_.X_BC).inverse() * disk.p_W(t_s);
    if (p_C.z() <= 1.2 * disk.radius_m) return {};
    const Eigen::Vector2d centre = camera_.project(p_C);
    return {centre.x(), centre.y(),
            camera_.mean_focal_px() * disk.radius_m /
                std::sqrt(p_C.z() * p_C.z() - disk.radius_m * disk.radius_m)};
  }

  static double coverage(const Circle& c, int x, int y) {
    if (c.radius < 0) return 0;
    return std::clamp(0.5 + c.radius - std::hypot(x - c.x, y - c.y), 0.0, 1.0);
  }

  void step(TimeUs to_us, std::vector<Event>& out) {
    touched_.clear();
    for (std::size_t k = 0; k < disks_.size(); ++k) {
      const Circle from = circles_[k], to = circle(disks_[k], to_us);
      circles_[k] = to;
      if (from.radius < 0 && to.radius < 0) continue;
      const Circle& any = to.radius < 0 ? from : to;
      const double moved =
          from.radius < 0 || to.radius < 0
              ? any.radius + 2
              : std::hypot(to.x - from.x, to.y - from.y) + std::abs(to.radius - from.radius);
      redraw(from, to, any, moved + 1, disks_[k].log_contrast);
    }
    for (const int i : touched_) fire(i, to_us, out);
    t_us_ = to_us;
  }

  // Only pixels within `margin` of the outline change.
  void redraw(const Circle& from, const Circle& to, const Circle& c, double margin,
              double contrast) {
    const double outer = c.radius + margin, inner = std::max(0.0, c.radius - margin);
    const int y0 = std::max(0, static_cast<int>(std::floor(c.y - outer)));
    const int y1 = std::min(camera_.height - 1, static_cast<int>(std::ceil(c.y + outer)));
    for (int y = y0; y <= y1; ++y) {
      const double dy2 = (y - c.y) * (y - c.y);
      const double half_out = std::sqrt(std::max(0.0, outer * outer - dy2)) + 1;
      const double half_in = std::sqrt(std::max(0.0, inner * inner - dy2)) - 1;
      const int x0 = std::max(0, static_cast<int>(std::ceil(c.x - half_out)));
      const int x1 = std::min(camera_.width - 1, static_cast<int>(std::floor(c.x + half_out)));
      for (int x = x0; x <= x1; ++x) {
        if (std::abs(x - c.x) < half_in) {
          x = std::max(x, static_cast<int>(std::floor(c.x + half_in)) - 1);
          if (std::abs(x - c.x) < half_in) continue;
        }
        const double change = coverage(to, x, y) - coverage(from, x, y);
        if (change == 0) continue;
        const int i = y * camera_.width + x;
        level_[static_cast<std::size_t>(i)] += static_cast<float>(contrast * change);
        touched_.push_back(i);
      }
    }
  }

  // Spreads the crossings of one pixel evenly over the step.
  void fire(int pixel, TimeUs to_us, std::vector<Event>& out) {
    const auto i = static_cast<std::size_t>(pixel);
    const float difference = level_[i] - reference_[i];
    const double passed = std::abs(difference) / threshold_[i];
    const int crossings = static_cast<int>(passed);
    if (crossings == 0) return;
    const int sign = difference > 0 ? 1 : -1;
    for (int n = 1; n <= crossings; ++n) {
      const double s = n / passed;
      const auto dt_us = static_cast<TimeUs>(std::ceil(s * static_cast<double>(to_us - t_us_)));
      out.push_back(event(t_us_ + dt_us, pixel, sign));
    }
    reference_[i] += static_cast<float>(sign * crossings) * threshold_[i];
  }

  Event event(TimeUs t_us, int pixel, int polarity) const {
    return {t_us, static_cast<std::uint16_t>(pixel % camera_.width),
            static_cast<std::uint16_t>(pixel / camera_.width), static_cast<std::int8_t>(polarity)};
  }

  void add_noise(TimeUs begin_us, TimeUs end_us, double rate_hz, const std::vector<int>* among,
                 std::vector<Event>& out) {
    if (rate_hz <= 0) return;
    double t_us = static_cast<double>(begin_us) + 1e6 * dodgesim::exponential(random_, rate_hz);
    while (t_us <= static_cast<double>(end_us)) {
      const std::size_t count = among != nullptr ? among->size() : level_.size();
      const auto pick = static_cast<std::size_t>(random_.uniform() * static_cast<double>(count));
      const int pixel = among != nullptr ? (*among)[pick] : static_cast<int>(pick);
      out.push_back(
          event(static_cast<TimeUs>(std::ceil(t_us)), pixel, random_.uniform() < 0.5 ? -1 : 1));
      t_us += 1e6 * dodgesim::exponential(random_, rate_hz);
    }
  }

  CameraModel camera_;
  Motion motion_;
  std::vector<Disk> disks_;
  Sensor sensor_;
  dodgesim::RandomStream random_;
  TimeUs t_us_;
  std::vector<float> level_, reference_, threshold_;
  std::vector<int> hot_, touched_;
  std::vector<Circle> circles_;
};

}  // namespace dodge::synthetic
