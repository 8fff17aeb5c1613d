// Ego-motion compensation: where would each event have appeared if the camera had not rotated?
// Falanga et al. 2020, eq. (1): every event is rotated by the mean angular rate of the window times
// the time between the event and the reference instant. Translation is neglected, as in the paper.
//
// The paper warps to the window's start t0; here the reference is the window's end by default, so
// that a compensated pixel is where the camera sees that direction now, and a detection needs no
// further rotation. The images of the two choices differ by one rotation of all pixels.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "dodge/camera_model.h"
#include "dodge/types.h"

namespace dodge {

struct EgoMotionConfig {
  bool enabled = true;
  std::string reference = "end";
  double max_error_px = 0.02;

  template <class Visitor>
  void visit(Visitor& v) {
    v("enabled", enabled, "Whether events are compensated for the camera's rotation.");
    v("reference", reference, {"start", "end"},
      "The instant events are rotated to: the window's start as printed in eq. (1), or its end, "
      "where pixels are the current ones.");
    v("max_error_px", max_error_px, 0.001, 1,
      "Events share a rotation matrix within time bins so short that no event is misplaced by "
      "more than this. Of the bins there are 4096 at most, enough for 41 rad/s in a window of "
      "10 ms by default.");
  }
};

// exp([v]x), Rodrigues' formula, for a rotation vector v [rad].
Eigen::Matrix3d rodrigues(const Eigen::Vector3d& v);

// Maps event pixels of one camera to compensated, undistorted pixels of the reference instant.
class EgoMotion {
 public:
  EgoMotion(const EgoMotionConfig& config, const CameraModel& camera);

  // w_WC_C: the camera's mean angular velocity in C [rad/s] over [begin_us, end_us].
  void set_motion(const Eigen::Vector3d& w_WC_C, TimeUs begin_us, TimeUs end_us);

  // A static ray obeys d(reference) = exp([w](t - reference)) d(t). One that has turned behind the
  // camera lands far outside of the image. Requires the event's pixel to lie in the image.
  Eigen::Vector2f warp(const Event& event) const {
    const Eigen::Matrix3f& H = bins_[bin_of(event)];
    const Eigen::Vector2f& d = bearing_of(event);
    const Eigen::Vector3f p = H.col(0) * d.x() + H.col(1) * d.y() + H.col(2);
    const float scale = 1.0F / std::max(p.z(), kLeastZ);
    return {p.x() * scale, p.y() * scale};
  }

  // The same for many events, faster: (u[i], v[i]) of events[i].
  void warp(std::span<const Event> events, float* u, float* v) const;

 private:
  static constexpr float kLeastZ = 0.01F;  // of a ray (x, y, 1) that was turned

  std::size_t bin_of(const Event& event) const {
    const auto bin =
        static_cast<std::ptrdiff_t>(static_cast<float>(event.t_us - begin_us_) * bins_per_us_);
    const auto last = static_cast<std::ptrdiff_t>(bins_.size()) - 1;
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(bin, 0, last));
  }
  const Eigen::Vector2f& bearing_of(const Event& event) const {
    return bearings_[static_cast<std::size_t>(event.y) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(event.x)];
  }

  EgoMotionConfig config_;
  Eigen::Matrix3d K_;
  int width_;
  double px_per_rad_;                      // the largest displacement of any pixel per rotation
  std::vector<Eigen::Vector2f> bearings_;  // of every pixel
  std::vector<Eigen::Matrix3f> bins_;      // K exp([w](t_bin - reference)), one a time bin
  TimeUs begin_us_ = 0;
  float bins_per_us_ = 0;
};

}  // namespace dodge
