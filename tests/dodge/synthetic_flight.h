// What a flight over a synthetic scene hands to a pilot with a vertical pair of cameras.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "dodge/pilot.h"
#include "tests/dodge/synthetic_events.h"

namespace dodge::synthetic {

inline constexpr TimeUs kCycleUs = 5000;  // of the pilot

class Flight {
 public:
  Flight(Motion motion, const std::vector<Disk>& disks, const Sensor& sensor, std::uint64_t seed)
      : motion_(std::move(motion)) {
    const std::vector<CameraModel> cameras = vertical_pair();
    for (std::size_t i = 0; i < 2; ++i) {
      generators_.emplace_back(cameras[i], motion_, disks, sensor, seed, i);
    }
  }

  // The IMU says nothing after that instant.
  void end_imu(TimeUs t_us) { imu_end_us_ = t_us; }

  // The events of the lower camera come this much later.
  void delay_lower_camera(TimeUs delay_us) { delay_us_[1] = delay_us; }

  // Collects the data of the cycle that ends now.
  void advance(TimeUs now_us) {
    for (std::size_t i = 0; i < 2; ++i) {
      events_[i].clear();
      generators_[i].advance(now_us - delay_us_[i], events_[i]);
    }
    imu_.clear();
    for (; imu_us_ <= std::min(now_us, imu_end_us_); imu_us_ += 1000) {
      imu_.push_back({imu_us_, rate(imu_us_), {}});
    }
    now_us_ = now_us;
  }

  // Hands them over and updates.
  VelocityCommand feed(Pilot& pilot) const {
    for (int i = 0; i < 2; ++i) pilot.add_events(i, events_[static_cast<std::size_t>(i)]);
    for (const ImuSample& sample : imu_) pilot.add_imu(sample);
    pilot.add_state(state(now_us_));
    return pilot.update(now_us_);
  }

  VelocityCommand cycle(Pilot& pilot, TimeUs now_us) {
    advance(now_us);
    return feed(pilot);
  }

  StateEstimate state(TimeUs t_us) const {
    const Eigen::Isometry3d X_WB = motion_(1e-6 * static_cast<double>(t_us));
    StateEstimate state;
    state.t_us = t_us;
    state.p_WB = X_WB.translation();
    state.q_WB = X_WB.linear();
    state.w_WB_B = rate(t_us);
    return state;
  }

 private:
  Eigen::Vector3d rate(TimeUs t_us) const {
    const double t_s = 1e-6 * static_cast<double>(t_us), h = 1e-4;
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(motion_(t_s - h).linear().transpose() * motion_(t_s + h).linear()));
    return turn.axis() * turn.angle() / (2 * h);
  }

  Motion motion_;
  std::vector<EventGenerator> generators_;
  std::array<TimeUs, 2> delay_us_ = {0, 0};
  std::array<std::vector<Event>, 2> events_;
  std::vector<ImuSample> imu_;
  TimeUs imu_us_ = 0, now_us_ = 0;
  TimeUs imu_end_us_ = std::numeric_limits<TimeUs>::max();
};

inline Eigen::Isometry3d still(double /*t_s*/) { return Eigen::Isometry3d::Identity(); }

// Slow at first, then faster and faster up to 2 rad/s.
inline Eigen::Isometry3d turning(double t_s) {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  X_WB.linear() = Eigen::AngleAxisd(2 / (2 * 3.0) * std::sin(3.0 * t_s),
                                    Eigen::Vector3d(0.5, 0.6, 0.6).normalized())
                      .toRotationMatrix();
  return X_WB;
}

}  // namespace dodge::synthetic
