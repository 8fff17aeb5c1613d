// The obstacles around the vehicle: associates detections, filters them, forgets what is long gone.
#pragma once

#include <span>
#include <vector>

#include "dodge/detect/association.h"
#include "dodge/detect/ellipsoid.h"
#include "dodge/detect/kalman.h"
#include "dodge/types.h"

namespace dodge {

// Obstacle as the avoidance sees it.
struct TrackedObstacle {
  Obstacle obstacle;                       // position and velocity at obstacle.t_us
  Matrix6d covariance = Matrix6d::Zero();  // of (p_WO, v_WO) [m, m/s]
  Ellipsoid ellipsoid;                     // around the obstacle at obstacle.t_us
  bool confirmed = false;                  // may cause an escape
};

// An obstacle whose state is known: a sphere of diameter size_m, detected at t_us, confirmed.
TrackedObstacle known_obstacle(int id, TimeUs t_us, const Eigen::Vector3d& p_WO,
                               const Eigen::Vector3d& v_WO, double size_m);

class Tracker {
 public:
  // Memory for so many is reserved from the start.
  static constexpr std::size_t kUsualObstacles = 256;

  // lifetime_s: how long an obstacle lives after its last detection (decay_lifetime_s of the
  // repulsive field, (33)). Throws std::invalid_argument if it is negative.
  Tracker(const AssociationConfig& association, const KalmanConfig& kalman, double lifetime_s);

  // Takes in the detections of one look (if there are none, it has missed all obstacles), fills in
  // their obstacle_id, removes obstacles that were not seen for too long, and predicts all to
  // `now_us`. Detections that are not finite are ignored and keep id -1.
  void update(TimeUs now_us, std::span<Detection> detections);

  // The same without a look, between the cameras' data.
  void predict(TimeUs now_us);

  // In the order of their ids, predicted to the last `now_us`.
  const std::vector<TrackedObstacle>& obstacles() const { return obstacles_; }

 private:
  struct Track {
    int id;
    Kalman filter;  // at the last detection's instant
    TimeUs last_detection_us;
    int detections = 0;
    double size_m = 0;
    Ellipsoid ellipsoid = {};  // centre_W counts from the obstacle's position
    bool confirmed = false;
    bool missed = false;  // not detected by the last look
  };

  static PredictedObstacle predicted(const Track& track, TimeUs t_us);
  void measure(Track& track, Detection& detection) const;
  void remove_stale(TimeUs now_us);
  void publish(TimeUs now_us);

  AssociationConfig association_;
  KalmanConfig kalman_;
  TimeUs lifetime_us_;
  Associator associator_;
  int next_id_ = 0;
  std::vector<Track> tracks_;
  std::vector<MeasuredPosition> measured_;
  std::vector<PredictedObstacle> predicted_;
  std::vector<TrackedObstacle> obstacles_;
};

}  // namespace dodge
