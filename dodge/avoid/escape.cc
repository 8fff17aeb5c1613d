#include "dodge/avoid/escape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dodge {
namespace {

using Eigen::Vector3d;

constexpr double kStepS = 0.01;  // between predicted positions; the approach is refined within one
constexpr int kDirections = 24;  // of escape, across the obstacle's line of flight
constexpr int kStrips = 32;      // of the disc over which a probability is integrated
constexpr double kNoSpeedMps = 1e-9;
constexpr double kNoDistanceM = 1e-9;
constexpr double kRounding = 1e-9;  // of a unit vector
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where a vehicle will be whose velocity changes from v to another at constant acceleration, after
// a dead time, and that stops where it is wanted.
class Course {
 public:
  Course(const EscapeConfig& config, const VehicleMotion& vehicle, const Intent& intent)
      : p_W_(vehicle.p_W), v_W_(vehicle.v_W) {
    if (intent.p_WG) way_W_ = *intent.p_WG - p_W_;
    const Vector3d change_W = intent.v_W - vehicle.v_W;
    const double size = change_W.norm();
    if (size <= kNoSpeedMps) return;
    const double level = change_W.head<2>().norm() / size;
    start_s_ = config.dead_time_s + level * config.tilt_time_s;
    length_s_ =
        size / (intent.acceleration_mps2 > 0 ? intent.acceleration_mps2 : config.acceleration_mps2);
    a_W_ = change_W / length_s_;
  }

  Vector3d position(double t_s) const {
    const Vector3d moved_W = way_without_goal(t_s);
    return p_W_ + (has_arrived(moved_W) ? way_W_ : moved_W);
  }
  Vector3d velocity(double t_s) const {
    if (has_arrived(way_without_goal(t_s))) return Vector3d::Zero();
    return v_W_ + std::clamp(t_s - start_s_, 0.0, length_s_) * a_W_;
  }

 private:
  Vector3d way_without_goal(double t_s) const {
    const double pushed_s = std::clamp(t_s - start_s_, 0.0, length_s_);
    const double coasted_s = std::max(0.0, t_s - start_s_ - length_s_);
    return t_s * v_W_ + (0.5 * pushed_s * pushed_s + pushed_s * coasted_s) * a_W_;
  }
  bool has_arrived(const Vector3d& moved_W) const {
    return way_W_.norm() > kNoDistanceM && moved_W.dot(way_W_) >= way_W_.squaredNorm();
  }

  Vector3d p_W_, v_W_;
  Vector3d way_W_ = Vector3d::Zero();  // to where it stops; zero if it does not
  Vector3d a_W_ = Vector3d::Zero();
  double start_s_ = 0, length_s_ = 0;  // of the acceleration
};

// Where an obstacle in free fall will be, and how well that is known.
class Fall {
 public:
  Fall(const TrackedObstacle& tracked, TimeUs now_us)
      : tracked_(tracked), age_s_(seconds(now_us - tracked.obstacle.t_us)) {}

  Vector3d position(double t_s) const {
    const double s = age_s_ + t_s;
    return tracked_.obstacle.p_WO + s * tracked_.obstacle.v_WO -
           0.5 * kGravityMps2 * s * s * Vector3d::UnitZ();
  }
  Vector3d velocity(double t_s) const {
    return tracked_.obstacle.v_WO - kGravityMps2 * (age_s_ + t_s) * Vector3d::UnitZ();
  }
  Eigen::Matrix3d covariance(double t_s) const {  // of the position
    const double s = age_s_ + t_s;
    const Matrix6d& P = tracked_.covariance;
    const Eigen::Matrix3d cross = P.topRightCorner<3, 3>() + P.bottomLeftCorner<3, 3>();
    return P.topLeftCorner<3, 3>() + s * cross + s * s * P.bottomRightCorner<3, 3>();
  }

 private:
  const TrackedObstacle& tracked_;
  double age_s_;
};

double normal_density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi); }
// Of a standard normal distribution below z.
double normal_share(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

// The direction across `along` that climbs most, or any if `along` is vertical.
Vector3d upward_across(const Vector3d& along) {
  const Vector3d up = Vector3d::UnitZ() - along.z() * along;
  return up.norm() > kNoSpeedMps ? up.normalized() : along.unitOrthogonal();
}

bool contains(std::span<const TrackedObstacle> obstacles, int id) {
  return std::any_of(obstacles.begin(), obstacles.end(),
                     [&](const TrackedObstacle& tracked) { return tracked.obstacle.id == id; });
}

}  // namespace

// In strips along the axis of the smaller standard deviation, each of which is exact. A
// density narrower than a strip could slip between two of them: a deviation below a tenth of the
// radius counts as a tenth.
double hit_probability(const Meeting& meeting) {
  constexpr double kLeastSigma = 0.1;
  const Vector3d a = meeting.along_W.unitOrthogonal(), b = meeting.along_W.cross(a);
  Eigen::Matrix<double, 3, 2> across;
  across << a, b;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(across.transpose() * meeting.covariance * across);
  if (!(axes.eigenvalues()[0] > 0)) return 0;
  const Eigen::Vector2d sigma =
      axes.eigenvalues().cwiseSqrt().cwiseMax(kLeastSigma * meeting.radius_m);
  const Eigen::Vector2d miss =
      axes.eigenvectors().transpose() * across.transpose() * meeting.miss_W;
  double sum = 0;
  for (int i = 0; i < kStrips; ++i) {
    const double angle = std::numbers::pi * ((i + 0.5) / kStrips - 0.5);
    const double half_length = meeting.radius_m * std::cos(angle);
    const double z = (meeting.radius_m * std::sin(angle) - miss[1]) / sigma[1];
    const double low = (-half_length - miss[0]) / sigma[0];
    const double high = (half_length - miss[0]) / sigma[0];
    // With d(sin angle) = cos(angle) d(angle) the width of a strip is proportional to its length.
    sum += half_length * normal_density(z) * (normal_share(high) - normal_share(low));
  }
  return sum * std::numbers::pi / (kStrips * sigma[1]);
}

EscapePlanner::EscapePlanner(const EscapeConfig& config, double speed_mps)
    : config_(config),
      speed_mps_(speed_mps),
      lowest_z_(-std::sin(config.steepest_descent_deg * std::numbers::pi / 180)) {
  evaded_ids_.reserve(Tracker::kUsualObstacles);
}

bool EscapePlanner::has_evaded(int id) const {
  return std::find(evaded_ids_.begin(), evaded_ids_.end(), id) != evaded_ids_.end();
}

bool EscapePlanner::is_thrown(const TrackedObstacle& tracked) const {
  if (!tracked.confirmed) return false;
  return tracked.obstacle.v_WO.norm() >= config_.min_speed_mps || has_evaded(tracked.obstacle.id);
}

std::optional<Meeting> EscapePlanner::meeting(TimeUs now_us, const VehicleMotion& vehicle,
                                              const Intent& intent,
                                              const TrackedObstacle& obstacle) const {
  const Course course(config_, vehicle, intent);
  const Fall fall(obstacle, now_us);
  int nearest = 0;
  double nearest_m2 = kInfinity;
  const int steps = static_cast<int>(std::lround(config_.horizon_s / kStepS));
  for (int i = 0; i <= steps; ++i) {
    const double t_s = i * kStepS;
    const double m2 = (fall.position(t_s) - course.position(t_s)).squaredNorm();
    if (m2 >= nearest_m2) continue;
    nearest_m2 = m2;
    nearest = i;
  }
  if (nearest == 0) return std::nullopt;

  Meeting meeting;
  meeting.time_s = nearest * kStepS;
  const Vector3d v_W = fall.velocity(meeting.time_s) - course.velocity(meeting.time_s);
  meeting.miss_W = fall.position(meeting.time_s) - course.position(meeting.time_s);
  if (v_W.norm() <= kNoSpeedMps) return std::nullopt;
  meeting.along_W = v_W.normalized();
  // To the nearest point between two steps, or straight on from the last one.
  const double earliest_s = nearest == steps ? -kInfinity : -kStepS;
  const double late_s = std::clamp(meeting.miss_W.dot(v_W) / v_W.squaredNorm(), earliest_s, kStepS);
  meeting.time_s -= late_s;
  meeting.miss_W -= late_s * v_W;
  meeting.covariance = fall.covariance(meeting.time_s) + config_.control_sigma_m *
                                                             config_.control_sigma_m *
                                                             Eigen::Matrix3d::Identity();
  meeting.radius_m = config_.hull_radius_m + 0.5 * obstacle.obstacle.size_m;
  return meeting;
}

// The least over all obstacles of the distance by which they miss, in its standard deviations.
double EscapePlanner::clearance_in_sigmas(TimeUs now_us, const VehicleMotion& vehicle,
                                          const Intent& intent,
                                          std::span<const TrackedObstacle> obstacles) const {
  double least = kInfinity;
  for (const TrackedObstacle& tracked : obstacles) {
    if (!is_thrown(tracked)) continue;
    const std::optional<Meeting> near = meeting(now_us, vehicle, intent, tracked);
    if (!near) continue;
    const double miss_m = near->miss_W.norm();
    const Vector3d towards = miss_m > 0 ? (near->miss_W / miss_m).eval() : Vector3d::UnitZ();
    const double sigma_m = std::sqrt(towards.dot(near->covariance * towards));
    least = std::min(least, (miss_m - near->radius_m) / sigma_m);
  }
  return least;
}

std::optional<EscapePlanner::Danger> EscapePlanner::greatest_danger(
    TimeUs now_us, const VehicleMotion& vehicle, const Intent& intent,
    std::span<const TrackedObstacle> obstacles) const {
  std::optional<Danger> greatest;
  for (const TrackedObstacle& tracked : obstacles) {
    if (!is_thrown(tracked)) continue;
    const std::optional<Meeting> near = meeting(now_us, vehicle, intent, tracked);
    if (!near || near->time_s > config_.horizon_s) continue;
    const double probability = hit_probability(*near);
    if (greatest && probability <= greatest->probability) continue;
    greatest = {tracked.obstacle.id, probability, near->along_W};
  }
  return greatest;
}

std::optional<Vector3d> EscapePlanner::escape(TimeUs now_us, const VehicleMotion& vehicle,
                                              const Intent& intent,
                                              std::span<const TrackedObstacle> obstacles) {
  std::erase_if(evaded_ids_, [&](int id) { return !contains(obstacles, id); });
  const std::optional<Danger> danger = greatest_danger(now_us, vehicle, intent, obstacles);
  const double least = direction_W_ ? config_.keep_probability : config_.min_probability;
  if (!danger || danger->probability <= 0 || danger->probability < least) {
    direction_W_.reset();
    return std::nullopt;
  }
  if (danger->probability >= config_.min_probability && !has_evaded(danger->id)) {
    evaded_ids_.push_back(danger->id);
  }
  direction_W_ = best_direction(now_us, vehicle, danger->along_W, obstacles);
  return speed_mps_ * *direction_W_;
}

// Of the directions across the line of flight of the obstacle that is the greatest danger, and the
// one that the vehicle takes already: to turn round costs the time to tilt.
Vector3d EscapePlanner::best_direction(TimeUs now_us, const VehicleMotion& vehicle,
                                       const Vector3d& along_W,
                                       std::span<const TrackedObstacle> obstacles) const {
  const auto clearance = [&](const Vector3d& direction_W) {
    const Intent escape{speed_mps_ * direction_W, std::nullopt};
    return clearance_in_sigmas(now_us, vehicle, escape, obstacles);
  };
  const Vector3d up = upward_across(along_W), left = up.cross(along_W);
  Vector3d best_W = direction_W_.value_or(up);
  double best = direction_W_ ? clearance(best_W) + config_.turn_sigmas : -kInfinity;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    const Vector3d direction_W = std::cos(angle) * up + std::sin(angle) * left;
    if (direction_W.z() < lowest_z_ - kRounding) continue;
    const double sigmas = clearance(direction_W);
    if (sigmas <= best) continue;
    best = sigmas;
    best_W = direction_W;
  }
  return best_W;
}

}  // namespace dodge
