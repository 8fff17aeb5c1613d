#include "dodge/detect/ego_motion.h"

#include <cmath>

namespace dodge {

namespace {

constexpr std::size_t kRateSamples = 2048;  // half a second at 4 kHz
constexpr double kMostBins = 4096;          // of faster turns events are misplaced by more

Eigen::Vector3d interpolate(const ImuSample& a, const ImuSample& b, TimeUs t_us) {
  if (b.t_us <= a.t_us) return b.w_WB_B;
  const double s = static_cast<double>(t_us - a.t_us) / static_cast<double>(b.t_us - a.t_us);
  return a.w_WB_B + s * (b.w_WB_B - a.w_WB_B);
}

}  // namespace

RateHistory::RateHistory() : samples_(kRateSamples) {}

void RateHistory::add(const ImuSample& sample) {
  if (!sample.w_WB_B.allFinite()) return;
  if (samples_.size() == samples_.capacity()) samples_.pop_front();
  samples_.push_back(sample);
}

Eigen::Vector3d RateHistory::at(TimeUs t_us) const {
  if (t_us <= samples_.front().t_us) return samples_.front().w_WB_B;
  if (t_us >= samples_.back().t_us) return samples_.back().w_WB_B;
  std::size_t i = samples_.size() - 1;
  while (samples_[i - 1].t_us > t_us) --i;
  return interpolate(samples_[i - 1], samples_[i], t_us);
}

Eigen::Vector3d RateHistory::mean(TimeUs begin_us, TimeUs end_us) const {
  if (samples_.empty()) return Eigen::Vector3d::Zero();
  if (end_us <= begin_us) return at(end_us);
  // Trapezoids from the end backwards: the samples needed are the newest ones.
  Eigen::Vector3d integral = Eigen::Vector3d::Zero();
  TimeUs t_us = end_us;
  Eigen::Vector3d rate = at(end_us);
  const auto add_piece = [&](TimeUs to_us, const Eigen::Vector3d& to_rate) {
    integral += 0.5 * static_cast<double>(t_us - to_us) * (rate + to_rate);
    t_us = to_us;
    rate = to_rate;
  };
  for (std::size_t i = samples_.size(); i-- > 0 && samples_[i].t_us > begin_us;) {
    if (samples_[i].t_us < end_us) add_piece(samples_[i].t_us, samples_[i].w_WB_B);
  }
  add_piece(begin_us, at(begin_us));
  return integral / static_cast<double>(end_us - begin_us);
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
