// A camera on a vehicle and objects that move at constant velocities, for tests of the sampler.
#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "sim/base/random.h"
#include "sim/events/sampler.h"
#include "tests/sim/events/moving_plane.h"

namespace dodgesim::testing {

inline const Intrinsics kIntrinsics;      // 320 x 240
inline constexpr TimeUs kLongest = 5000;  // 1/min_rate_hz of the default
inline constexpr double kFar = 1e6;

// Camera in front of and above the vehicle's centre, looking along x_B, pitched down by 0.2 rad.
inline Eigen::Isometry3d mounted_camera() {
  Eigen::Isometry3d X = MovingPlane::X_BC();
  X.linear() = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) * X.linear();
  X.translation() = Eigen::Vector3d(0.1, 0.02, 0.075);
  return X;
}

// Bodies that move at constant velocities from their state at t = 0.
inline BodyState moved(const BodyState& start, TimeUs t_us) {
  BodyState s = start;
  s.p_W += start.v_W * seconds(t_us);
  const double angle = start.w_W.norm() * seconds(t_us);
  if (angle > 0) s.q_W = Eigen::AngleAxisd(angle, start.w_W.normalized()) * start.q_W;
  return s;
}

inline Snapshot scene(const Snapshot& start, TimeUs t_us) {
  Snapshot s = start;
  s.t_us = t_us;
  s.vehicle = moved(start.vehicle, t_us);
  for (std::size_t i = 0; i < s.objects.size(); ++i) s.objects[i] = moved(start.objects[i], t_us);
  return s;
}

inline std::vector<Sample> run_samples(Sampler& sampler, const Snapshot& start,
                                       const StaticDistances& distances, TimeUs end_us) {
  std::vector<Sample> samples;
  sampler.reset(0);
  for (TimeUs t = 0; t < end_us; t += kTickUs) {
    sampler.advance(scene(start, t), scene(start, t + kTickUs), distances, samples);
  }
  return samples;
}

inline std::vector<Sample> run_samples(Sampler& sampler, const Snapshot& start, double nearest_m,
                                       TimeUs end_us) {
  return run_samples(sampler, start, StaticDistances(nearest_m), end_us);
}

inline std::vector<TimeUs> times_of(const std::vector<Sample>& samples) {
  std::vector<TimeUs> times;
  times.reserve(samples.size());
  for (const Sample& sample : samples) times.push_back(sample.t_us);
  return times;
}

inline std::vector<TimeUs> run(Sampler& sampler, const Snapshot& start, double nearest_m,
                               TimeUs end_us) {
  return times_of(run_samples(sampler, start, nearest_m, end_us));
}

inline Sampler sampler_for(std::vector<double> radii, const SamplingSpec& spec = SamplingSpec()) {
  return Sampler(spec, kIntrinsics, mounted_camera(), std::move(radii));
}

inline Eigen::Vector3d random_vector(RandomStream& random, double length) {
  return length * Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

inline Snapshot random_scene(RandomStream& random) {
  Snapshot start;
  start.vehicle.v_W = random_vector(random, random.uniform(0, 5));
  start.vehicle.w_W = random_vector(random, random.uniform(0, 6));
  start.objects.resize(1);
  start.launched = {true};
  BodyState& object = start.objects[0];
  object.p_W =
      Eigen::Vector3d(random.uniform(0.6, 4), random.uniform(-4, 4), random.uniform(-3, 3));
  object.v_W = random_vector(random, random.uniform(0, 10)) - 0.8 * object.p_W;
  object.w_W = random_vector(random, random.uniform(0, 20));
  return start;
}

// Speed of the corners of the image [px/s] when the camera turns about y_C.
inline double corner_speed(double rate_radps) {
  const double x = 160 / kIntrinsics.f;
  const double y = 120 / kIntrinsics.f;
  return rate_radps * kIntrinsics.f * std::hypot(1 + x * x, x * y);
}

}  // namespace dodgesim::testing
