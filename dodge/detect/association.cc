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

std::span<const int> Associator::associate(std::span<const Detection> detections,
                                           std::span<const PredictedObstacle> obstacles) {
  pairs_.clear();
  for (std::size_t d = 0; d < detections.size(); ++d) {
    for (std::size_t o = 0; o < obstacles.size(); ++o) {
      const Eigen::Vector3d offset = detections[d].centre_W - obstacles[o].p_W;
      const double distance = offset.norm();
      double radius = obstacles[o].detections <= 1 ? config_.first_radius_m : config_.radius_m;
      if (config_.widen_sigmas > 0 && distance > 0) {
        const Eigen::Vector3d towards = offset / distance;
        radius += config_.widen_sigmas * std::sqrt(towards.dot(obstacles[o].P_W * towards));
      }
      if (distance <= radius) {
        pairs_.push_back({distance, static_cast<int>(d), static_cast<int>(o)});
      }
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance_m, a.detection, a.obstacle) <
           std::tie(b.distance_m, b.detection, b.obstacle);
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
