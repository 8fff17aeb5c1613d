#include "dodge/detect/association.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace dodge {

namespace {
constexpr double kForbidden = std::numeric_limits<double>::infinity();
constexpr std::size_t kUsual = 1024;  // pairs that fit, detections and obstacles
}  // namespace

Associator::Associator(const AssociationConfig& config) : config_(config) {
  pairs_.reserve(kUsual);
  obstacle_of_.reserve(kUsual);
  taken_.reserve(kUsual);
}

// The least goes together; infinite for a pair that does not. In the spheres it is the distance.
// With a gate it is -2 ln of the density of the offset, less a constant: by deviations alone, what
// is known worst would be nearest to everything.
double Associator::cost(const MeasuredPosition& detection,
                        const PredictedObstacle& obstacle) const {
  const Eigen::Vector3d offset = detection.p_W - obstacle.p_W;
  if (config_.gate_sigmas > 0) {
    const Eigen::Matrix3d S = obstacle.P_W + detection.R_W;
    const double sigmas_squared = offset.dot(S.llt().solve(offset));
    const bool fits = sigmas_squared <= config_.gate_sigmas * config_.gate_sigmas;
    return fits ? sigmas_squared + std::log(S.determinant()) : kForbidden;
  }
  const double radius = obstacle.detections <= 1
                            ? config_.first_radius_m + config_.first_speed_mps * obstacle.unseen_s
                            : config_.radius_m;
  const double distance = offset.norm();
  return distance <= radius ? distance : kForbidden;
}

std::span<const int> Associator::associate(std::span<const MeasuredPosition> detections,
                                           std::span<const PredictedObstacle> predicted) {
  const std::size_t obstacles = detections.empty() ? 0 : predicted.size() / detections.size();
  pairs_.clear();
  for (std::size_t d = 0; d < detections.size(); ++d) {
    for (std::size_t o = 0; o < obstacles; ++o) {
      const double c = cost(detections[d], predicted[d * obstacles + o]);
      if (c < kForbidden) pairs_.push_back({c, static_cast<int>(d), static_cast<int>(o)});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.cost, a.detection, a.obstacle) < std::tie(b.cost, b.detection, b.obstacle);
  });
  obstacle_of_.assign(detections.size(), -1);
  taken_.assign(obstacles, 0);
  for (const Pair& pair : pairs_) {
    int& mine = obstacle_of_[static_cast<std::size_t>(pair.detection)];
    char& taken = taken_[static_cast<std::size_t>(pair.obstacle)];
    if (mine >= 0 || taken != 0) continue;
    mine = pair.obstacle;
    taken = 1;
  }
  return obstacle_of_;
}

}  // namespace dodge
