#include "sim/events/sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace dodgesim {

namespace {

// The speed of the static scene is evaluated at the corners of the parts of the view. At one
// distance it is a smooth function of the place, and in a part largest at its border.
constexpr int kGridColumns = StaticDistances::kColumns + 1;
constexpr int kGridRows = StaticDistances::kRows + 1;

// No surface is taken to be nearer than this, so that all speeds stay finite [m].
constexpr double kNearestM = 1e-3;

// An object counts as visible this many displacement limits before it enters the view. At constant
// speed one would do: the sample after it crossed that line still comes before it enters. Four
// leave room for what speeds up on the way.
constexpr double kViewMarginLimits = 4;

// A region's margin beyond what the object may move until its next sample [px].
constexpr double kRegionMarginPx = 1;

constexpr TimeUs kNever = std::numeric_limits<TimeUs>::max();

// Of the parts that meet at a corner.
double nearest_at(const StaticDistances& distances, int column, int row) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int j = std::max(row - 1, 0); j <= std::min(row, StaticDistances::kRows - 1); ++j) {
    for (int i = std::max(column - 1, 0); i <= std::min(column, StaticDistances::kColumns - 1);
         ++i) {
      nearest_m = std::min(nearest_m, distances.at(i, j));
    }
  }
  return std::max(nearest_m, kNearestM);
}

}  // namespace

Rect StaticDistances::part(const Intrinsics& view, int column, int row) {
  return {view.width * column / kColumns, view.height * row / kRows,
          (view.width * (column + 1) + kColumns - 1) / kColumns,
          (view.height * (row + 1) + kRows - 1) / kRows};
}

Sampler::Sampler(const SamplingSpec& spec, const Intrinsics& intrinsics,
                 const Eigen::Isometry3d& X_BC, std::vector<double> object_radius_m)
    : spec_(spec),
      intrinsics_(intrinsics),
      X_BC_(X_BC),
      object_radius_m_(std::move(object_radius_m)),
      max_interval_us_(static_cast<TimeUs>(1e6 / spec.min_rate_hz)),
      parts_(1 + object_radius_m_.size()),
      last_seen_(object_radius_m_.size()) {
  if (!(spec.max_displacement_px > 0) || max_interval_us_ < 1 || spec.min_interval_us < 1) {
    throw std::invalid_argument("The sampling of an event camera needs positive limits.");
  }
  const double f = intrinsics.f;
  const double half_width = 0.5 * intrinsics.width / f;
  const double half_height = 0.5 * intrinsics.height / f;
  for (int j = 0; j < kGridRows; ++j) {
    for (int i = 0; i < kGridColumns; ++i) {
      view_grid_.emplace_back(half_width * (2.0 * i / (kGridColumns - 1) - 1),
                              half_height * (2.0 * j / (kGridRows - 1) - 1));
    }
  }
  const double margin = kViewMarginLimits * spec.max_displacement_px / f;
  const double right = half_width + margin;
  const double bottom = half_height + margin;
  for (const double sign : {-1.0, 1.0}) {
    view_planes_.push_back(Eigen::Vector3d(sign, 0, right).normalized());
    view_planes_.push_back(Eigen::Vector3d(0, sign, bottom).normalized());
  }
  max_secant_ = Eigen::Vector3d(right, bottom, 1).norm();
}

void Sampler::reset(TimeUs t_us) {
  required_us_.clear();
  sampled({t_us, Sample::kWholeImage});
  std::fill(last_seen_.begin(), last_seen_.end(), ImageBox());
}

void Sampler::require(TimeUs t_us) {
  if (t_us <= parts_[0].last_us) return;
  const auto place = std::lower_bound(required_us_.begin(), required_us_.end(), t_us);
  if (place == required_us_.end() || *place != t_us) required_us_.insert(place, t_us);
}

void Sampler::set_speeds(const Snapshot& a, const Snapshot& b, const StaticDistances& distances) {
  parts_[0].speed_pxps = std::max(static_speed(a, distances), static_speed(b, distances));
  for (std::size_t i = 0; i < object_radius_m_.size(); ++i) {
    parts_[1 + i].speed_pxps = std::max(object_speed(a, i), object_speed(b, i));
  }
}

void Sampler::advance(const Snapshot& a, const Snapshot& b, const StaticDistances& distances,
                      std::vector<Sample>& samples) {
  set_speeds(a, b, distances);
  TimeUs now_us = a.t_us;
  while (true) {
    const Sample sample = next_sample(now_us);
    const double dt_s = seconds(std::min(sample.t_us, b.t_us) - now_us);
    for (Part& part : parts_) part.moved_px += part.speed_pxps * dt_s;
    if (sample.t_us > b.t_us) return;
    samples.push_back(sample);
    now_us = sample.t_us;
    sampled(sample);
  }
}

void Sampler::sampled(const Sample& sample) {
  const auto restart = [&sample](Part& part) {
    part.last_us = sample.t_us;
    part.moved_px = 0;
  };
  if (sample.object != Sample::kWholeImage) {
    restart(parts_[1 + static_cast<std::size_t>(sample.object)]);
    return;
  }
  for (Part& part : parts_) restart(part);
  const auto later = std::upper_bound(required_us_.begin(), required_us_.end(), sample.t_us);
  required_us_.erase(required_us_.begin(), later);
}

// The instant at which the motion of a part asks for its next sample, if the speed lasts.
TimeUs Sampler::time_of_motion(const Part& part, TimeUs now_us) const {
  const double left_px = std::max(0.0, spec_.max_displacement_px - part.moved_px);
  // Beyond the longest interval nobody asks.
  if (part.speed_pxps * seconds(max_interval_us_) <= left_px) return kNever;
  const TimeUs t_us = now_us + static_cast<TimeUs>(1e6 * left_px / part.speed_pxps);
  return std::max(t_us, part.last_us + spec_.min_interval_us);
}

// The instant at which what was seen must be known.
TimeUs Sampler::time_due() const {
  const TimeUs longest_us = parts_[0].last_us + max_interval_us_;
  return required_us_.empty() ? longest_us : std::min(longest_us, required_us_.front());
}

// The sample after now_us that is due first if the speeds last.
Sample Sampler::next_sample(TimeUs now_us) const {
  const auto later = [now_us](TimeUs t_us) { return std::max(t_us, now_us + 1); };
  Sample next{later(std::min(time_of_motion(parts_[0], now_us), time_due()))};
  for (std::size_t i = 0; i < object_radius_m_.size(); ++i) {
    const TimeUs t_us = later(time_of_motion(parts_[1 + i], now_us));
    if (t_us < next.t_us) next = {t_us, static_cast<int>(i)};
  }
  return next;
}

ImageBox Sampler::bounds(const Snapshot& snapshot, std::size_t object) const {
  if (!snapshot.launched[object]) return ImageBox();
  const Eigen::Isometry3d X_WC = snapshot.vehicle.pose() * X_BC_;
  return sphere_bounds(intrinsics_, X_WC.inverse() * snapshot.objects[object].p_W,
                       object_radius_m_[object]);
}

Rect Sampler::outline(const Snapshot& snapshot, std::size_t object) const {
  return pixels_about(bounds(snapshot, object), kRegionMarginPx, intrinsics_);
}

Rect Sampler::region(const Sample& sample, const Snapshot& snapshot) {
  if (sample.object == Sample::kWholeImage) {
    for (std::size_t i = 0; i < last_seen_.size(); ++i) last_seen_[i] = bounds(snapshot, i);
    return {0, 0, intrinsics_.width, intrinsics_.height};
  }
  const auto object = static_cast<std::size_t>(sample.object);
  const ImageBox box = bounds(snapshot, object);
  const ImageBox both = last_seen_[object].merged(box);
  last_seen_[object] = box;
  const double until_next_px = object_speed(snapshot, object) * seconds(spec_.min_interval_us);
  return pixels_about(both, std::max(spec_.max_displacement_px, until_next_px) + kRegionMarginPx,
                      intrinsics_);
}

Sampler::CameraMotion Sampler::camera_motion(const Snapshot& snapshot) const {
  const BodyState& body = snapshot.vehicle;
  CameraMotion camera;
  camera.X_WC = body.pose() * X_BC_;
  const Eigen::Matrix3d R_CW = camera.X_WC.linear().transpose();
  const Eigen::Vector3d p_BC_W = body.q_W * X_BC_.translation();
  camera.v_C = R_CW * (body.v_W + body.w_W.cross(p_BC_W));
  camera.w_C = R_CW * body.w_W;
  return camera;
}

double Sampler::static_speed(const Snapshot& snapshot, const StaticDistances& distances) const {
  const CameraMotion camera = camera_motion(snapshot);
  const Eigen::Vector3d& w = camera.w_C;
  const Eigen::Vector3d& v = camera.v_C;
  double fastest = 0;
  for (std::size_t i = 0; i < view_grid_.size(); ++i) {
    const Eigen::Vector2d& p = view_grid_[i];
    const double x = p.x();
    const double y = p.y();
    const auto node = static_cast<int>(i);
    const double distance = nearest_at(distances, node % kGridColumns, node / kGridColumns);
    // Image motion of a static point (x, y, 1) Z: d/dt of X/Z and Y/Z with dp/dt = -v - w x p.
    const double approach = w.x() * y - w.y() * x;
    const Eigen::Vector2d turn(-w.y() + w.z() * y + x * approach, w.x() - w.z() * x + y * approach);
    const double inverse_depth = std::sqrt(1 + p.squaredNorm()) / distance;
    const Eigen::Vector2d shift(-v.x() + x * v.z(), -v.y() + y * v.z());
    // The speed is a convex function of the inverse depth: its maximum is at one of the ends.
    const Eigen::Vector2d parallax = inverse_depth * shift;
    fastest = std::max({fastest, turn.norm(), (turn + parallax).norm()});
  }
  return intrinsics_.f * fastest;
}

double Sampler::object_speed(const Snapshot& snapshot, std::size_t object) const {
  if (!snapshot.launched[object]) return 0;
  const CameraMotion camera = camera_motion(snapshot);
  const BodyState& body = snapshot.objects[object];
  const double radius = object_radius_m_[object];
  const Eigen::Vector3d c = camera.X_WC.inverse() * body.p_W;
  for (const Eigen::Vector3d& plane : view_planes_) {
    if (plane.dot(c) < -radius) return 0;
  }
  const double distance = std::max(c.norm(), kNearestM);
  const double near = std::max(distance - radius, kNearestM);
  const double half_angle = std::asin(std::min(1.0, radius / distance));
  const Eigen::Vector3d ray = c / distance;
  const Eigen::Vector3d u = camera.X_WC.linear().transpose() * body.v_W - camera.v_C;
  const Eigen::Vector3d u_across = u - ray * ray.dot(u);
  // Angular speed of the centre, then how much more any other visible point can have: by its
  // direction (growth included), by being nearer, by the camera's rotation, by the object's spin.
  const double angular =
      (u_across / distance - camera.w_C.cross(ray)).norm() +
      u.norm() * std::sin(half_angle) / near + u_across.norm() * (1 / near - 1 / distance) +
      camera.w_C.norm() * 2 * std::sin(0.5 * half_angle) + body.w_W.norm() * radius / near;
  // A pinhole camera stretches angles by up to 1/cos^2 of the angle to the optical axis.
  const double axis_angle = std::acos(std::clamp(ray.z(), -1.0, 1.0)) + half_angle;
  const double cosine =
      axis_angle < 1.5 ? std::max(std::cos(axis_angle), 1 / max_secant_) : 1 / max_secant_;
  return intrinsics_.f * angular / (cosine * cosine);
}

}  // namespace dodgesim
