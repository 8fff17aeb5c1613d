#include "dodge/detect/ego_motion.h"

#include <cmath>

namespace dodge {

namespace {
constexpr double kMostBins = 4096;  // of faster turns events are misplaced by more
}

Eigen::Matrix3d rodrigues(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  Eigen::Matrix3d skew;
  skew << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  if (angle < 1e-8) return Eigen::Matrix3d::Identity() + skew;
  return Eigen::Matrix3d::Identity() + std::sin(angle) / angle * skew +
         (1 - std::cos(angle)) / (angle * angle) * skew * skew;
}

EgoMotion::EgoMotion(const EgoMotionConfig& config, const CameraModel& camera)
    : config_(config), width_(camera.width), bearings_(camera.bearing_table()) {
  K_ << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  // A bearing d turns by at most |w| dt; on the image plane this is f (1 + |d|^2) px per rad.
  float largest = 0;
  for (const Eigen::Vector2f& d : bearings_) largest = std::max(largest, d.squaredNorm());
  px_per_rad_ = std::max(camera.fx, camera.fy) * (1 + largest);
  bins_.reserve(static_cast<std::size_t>(kMostBins));
  set_motion(Eigen::Vector3d::Zero(), 0, 0);
}

// Events of a time bin share a matrix: a loop without branches.
void EgoMotion::warp(std::span<const Event> events, float* __restrict u,
                     float* __restrict v) const {
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Eigen::Vector2f& d = bearing_of(events[i]);
    u[i] = d.x();
    v[i] = d.y();
  }
  for (std::size_t first = 0, end = 0; first < events.size(); first = end) {
    const std::size_t bin = bin_of(events[first]);
    while (end < events.size() && bin_of(events[end]) == bin) ++end;
    const Eigen::Matrix3f H = bins_[bin];
    for (std::size_t i = first; i < end; ++i) {
      const float x = H(0, 0) * u[i] + H(0, 1) * v[i] + H(0, 2);
      const float y = H(1, 0) * u[i] + H(1, 1) * v[i] + H(1, 2);
      const float z = H(2, 0) * u[i] + H(2, 1) * v[i] + H(2, 2);
      const float scale = 1.0F / std::max(z, kLeastZ);
      u[i] = x * scale;
      v[i] = y * scale;
    }
  }
}

void EgoMotion::set_motion(const Eigen::Vector3d& w_WC_C, TimeUs begin_us, TimeUs end_us) {
  const double length_us = static_cast<double>(end_us - begin_us);
  const double length_s = seconds(end_us - begin_us);
  const Eigen::Vector3d w = config_.enabled ? w_WC_C : Eigen::Vector3d::Zero();
  // An event lies at most half a bin from the bin's centre.
  const double travel_px = px_per_rad_ * w.norm() * length_s;
  const double needed = std::ceil(0.5 * travel_px / config_.max_error_px);
  // All there are for NaN, which a rate makes whose square is no number any more.
  const auto count =
      static_cast<std::size_t>(needed < kMostBins ? std::max(needed, 1.0) : kMostBins);
  begin_us_ = begin_us;
  bins_per_us_ = length_us > 0 ? static_cast<float>(static_cast<double>(count) / length_us) : 0;

  const double bin_s = length_s / static_cast<double>(count);
  const double reference_s = config_.reference == "end" ? length_s : 0.0;
  Eigen::Matrix3d H = K_ * rodrigues(w * (0.5 * bin_s - reference_s));
  const Eigen::Matrix3d step = rodrigues(w * bin_s);  // same axis: the rotations commute
  bins_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    bins_.push_back(H.cast<float>());
    H = H * step;
  }
}

}  // namespace dodge
