// Decides at which instants which part of a camera's image is sampled, from the true motion.
//
// Between two samples the luminance of a pixel is taken to run linearly in time, so nothing may
// move far from one sample to the next. For the static scene and for each object the sampler adds
// up a bound on the distance that any of its visible points moves in the image, and asks for a
// sample when one of them reaches SamplingSpec::max_displacement_px: of the whole image for the
// static scene, of the region about the object for an object. Each camera has its own sampler.
//
// A region reaches so far beyond the object that it holds the pixels that the object enters or
// leaves until its next sample. Each pixel's curve then bends where the object's edge comes and
// goes, and runs straight while it shows the static scene.
//
// What a loop must do with events that are known late: an event is known once the whole image has
// been sampled at or after its stamp, and a packet that ends at T is complete then
// (see packetizer.h). So that no packet is late, the loop asks by require(T) for a sample at the
// end T of the last packet that the pilot's next cycle will read; between the cycles only the
// motion asks for samples. A loop that does not is late by at most the longest interval,
// 1/min_rate_hz.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <vector>

#include "sim/base/time.h"
#include "sim/camera/camera.h"
#include "sim/camera/sphere_bounds.h"
#include "sim/events/spec.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

// A picture that is wanted.
struct Sample {
  TimeUs t_us = 0;
  int object = kWholeImage;  // the index of the object whose region is wanted

  static constexpr int kWholeImage = -1;

  bool operator==(const Sample&) const = default;
};

// Lower bounds on the distance from a camera to the static scene [m], for each part of its view,
// row by row. The sky is infinitely far.
struct StaticDistances {
  static constexpr int kColumns = 8, kRows = 6;

  explicit StaticDistances(double everywhere_m) { m.fill(everywhere_m); }

  double& at(int column, int row) { return m[index(column, row)]; }
  double at(int column, int row) const { return m[index(column, row)]; }
  // The pixels of a part.
  static Rect part(const Intrinsics& view, int column, int row);

  std::array<double, std::size_t{kColumns} * kRows> m;

 private:
  static std::size_t index(int column, int row) {
    return static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column);
  }
};

class Sampler {
 public:
  // `X_BC` is the pose of the camera in the vehicle's frame, `object_radius_m` the radius of the
  // sphere about each object's origin that encloses it. Throws std::invalid_argument if the
  // parameters do not allow any sampling.
  Sampler(const SamplingSpec& spec, const Intrinsics& intrinsics, const Eigen::Isometry3d& X_BC,
          std::vector<double> object_radius_m);

  // The whole image has been sampled at t_us. Forgets what was required.
  void reset(TimeUs t_us);

  // Asks for a sample of the whole image exactly at t_us, which lies after the end of the last
  // advance().
  void require(TimeUs t_us);

  // Appends the samples to take in (a.t_us, b.t_us], in order, no two at the same instant. a and b
  // are a tick apart, and consecutive calls follow each other; `distances` hold all the while.
  // Objects that are not launched do not count.
  void advance(const Snapshot& a, const Snapshot& b, const StaticDistances& distances,
               std::vector<Sample>& samples);

  // Where an object is, to be drawn over a picture of the static scene; may be empty.
  Rect outline(const Snapshot& snapshot, std::size_t object) const;

  // The pixels that a sample is of, which may be none. `snapshot` is of the sample's instant. To be
  // called for every sample, in order: an object's region also holds its place in the sample
  // before.
  Rect region(const Sample& sample, const Snapshot& snapshot);

  // Bounds on the speed in the image at one instant [px/s].
  double static_speed(const Snapshot& snapshot, const StaticDistances& distances) const;
  double object_speed(const Snapshot& snapshot, std::size_t object) const;  // 0: out of view

 private:
  // Motion of the camera, in C.
  struct CameraMotion {
    Eigen::Isometry3d X_WC;
    Eigen::Vector3d v_C;  // velocity of the camera's centre [m/s]
    Eigen::Vector3d w_C;  // angular velocity [rad/s]
  };
  CameraMotion camera_motion(const Snapshot& snapshot) const;
  // What moves, and how far it has moved since it was last sampled.
  struct Part {
    TimeUs last_us = 0;     // of its last sample
    double moved_px = 0;    // since then
    double speed_pxps = 0;  // over the current tick
  };
  TimeUs time_of_motion(const Part& part, TimeUs now_us) const;
  TimeUs time_due() const;
  void set_speeds(const Snapshot& a, const Snapshot& b, const StaticDistances& distances);
  Sample next_sample(TimeUs now_us) const;
  void sampled(const Sample& sample);
  ImageBox bounds(const Snapshot& snapshot, std::size_t object) const;

  SamplingSpec spec_;
  Intrinsics intrinsics_;
  Eigen::Isometry3d X_BC_;
  std::vector<double> object_radius_m_;
  std::vector<Eigen::Vector2d> view_grid_;    // normalised image coordinates, corners included
  std::vector<Eigen::Vector3d> view_planes_;  // unit normals into the enlarged view
  double max_secant_;                         // 1/cos of the angle of the corners of the view
  TimeUs max_interval_us_;

  std::vector<TimeUs> required_us_;  // later than the last sample of the whole image, in order

  std::vector<Part> parts_;          // the static scene, then each object
  std::vector<ImageBox> last_seen_;  // each object at its last region()
};

}  // namespace dodgesim
