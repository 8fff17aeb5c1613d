#include "dodge/detect/association.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "dodge/check_ranges.h"

namespace dodge {

namespace {
constexpr std::size_t kUsual = 1024;  // pairs within the radii, detections and obstacles
}

Associator::Associator(const AssociationConfig& config) : config_(config) {
  check_ranges(config, "association.");
  pairs_.reserve(kUsual);
  obstacle_of_.reserve(kUsual);
  taken_.reserve(kUsual);
}

// How far apart they are: in metres, or in standard deviations if there is a gate.
double Associator::distance(const MeasuredPosition& detection,
                            const PredictedObstacle& obstacle) const {
  const Eigen::Vector3d offset = detection.p_W - obstacle.p_W;
  if (config_.gate_sigmas == 0) return offset.norm();
  return std::sqrt(offset.dot((obstacle.P_W + detection.R_W).llt().solve(offset)));
}

std::span<const int> Associator::associate(std::span<const MeasuredPosition> detections,
                                           std::span<const PredictedObstacle> obstacles) {
  pairs_.clear();
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const double radius = obstacles[o].detections <= 1 ? config_.first_radius_m : config_.radius_m;
    const double farthest = config_.gate_sigmas > 0 ? config_.gate_sigmas : radius;
    for (std::size_t d = 0; d < detections.size(); ++d) {
      const double apart = distance(detections[d], obstacles[o]);
      if (apart <= farthest) pairs_.push_back({apart, static_cast<int>(d), static_cast<int>(o)});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance, a.detection, a.obstacle) <
           std::tie(b.distance, b.detection, b.obstacle);
  });
  obstacle_of_.assign(detections.size(), -1);
  taken_.assign(obstacles.size(), 0);
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
