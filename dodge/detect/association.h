// Which detection belongs to which obstacle: Falanga et al. 2020, "Obstacle correspondence".
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <span>
#include <vector>

#include "dodge/types.h"

namespace dodge {

struct AssociationConfig {
  double first_radius_m = 0.10;
  double first_speed_mps = 10.0;
  double radius_m = 0.35;
  double gate_sigmas = 0.0;
  int min_detections = 3;
  std::int64_t tentative_timeout_us = 25000;

  template <class Visitor>
  void visit(Visitor& v) {
    v("first_radius_m", first_radius_m, 1e-3, 100.0,
      "Farthest a detection may be from an obstacle that was detected once, whose velocity is not "
      "known yet: the error of both positions. Not given by the paper (the authors' group's open "
      "code has 0.4 in all, which the false detections of a textured room meet, too).");
    v("first_speed_mps", first_speed_mps, 0.0, 1000.0,
      "How fast such an obstacle may be: it may be farther by the way it has come since. 10: the "
      "paper's fastest throws.");
    v("radius_m", radius_m, 1e-3, 100.0,
      "Farthest a detection may be from the predicted position of an obstacle. Not given by the "
      "paper; from the authors' group's open code.");
    v("gate_sigmas", gate_sigmas, 0.0, 100.0,
      "Takes the place of both radii and of first_speed_mps: farthest a detection may be from the "
      "predicted position, in standard deviations of their difference (Mahalanobis distance; 3 "
      "keeps 97 % of what belongs to it), and of several the likeliest pair goes together. 0: the "
      "paper's spheres.");
    v("min_detections", min_detections, 1, 1000,
      "Detections before an obstacle is confirmed, that is, may cause an escape. One has no "
      "velocity; two false ones fall together now and then in flight through a textured room. Not "
      "given by the paper.");
    v("tentative_timeout_us", tentative_timeout_us, std::int64_t{0}, std::int64_t{10000000},
      "An obstacle that is not confirmed is dropped this long after its last detection, so that "
      "unrelated noise does not add up to an obstacle, but never before it was looked for and "
      "missed. Not given by the paper.");
  }
};

// An obstacle as association sees it, at the instant of a detection.
struct PredictedObstacle {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  // [m]
  Eigen::Matrix3d P_W = Eigen::Matrix3d::Zero();  // covariance of p_W [m^2]
  int detections = 0;                             // so far
  double unseen_s = 0.0;                          // since the last of them
};

// A detection as association sees it.
struct MeasuredPosition {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  // [m]
  Eigen::Matrix3d R_W = Eigen::Matrix3d::Zero();  // covariance of p_W [m^2]
};

// One-to-one association, closest (with a gate, likeliest) pairs first; ties go to the lower
// detection index, then to the lower obstacle index. Reuses its memory.
class Associator {
 public:
  explicit Associator(const AssociationConfig& config);

  // For each detection the index of its obstacle, or -1. Valid until the next call. `predicted`
  // has all obstacles for the first detection, then all for the next: whole rows.
  std::span<const int> associate(std::span<const MeasuredPosition> detections,
                                 std::span<const PredictedObstacle> predicted);

 private:
  struct Pair {
    double cost;
    int detection;
    int obstacle;
  };
  double cost(const MeasuredPosition& detection, const PredictedObstacle& obstacle) const;

  AssociationConfig config_;
  std::vector<Pair> pairs_;
  std::vector<int> obstacle_of_;
  std::vector<char> taken_;
};

}  // namespace dodge
