#include "dodge/detect/tracker.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dodge {
namespace {

constexpr double kUsPerSecond = 1e6;
// Half the least thickness of an obstacle's ellipsoid, well below any thrown object's.
constexpr double kMinHalfWidthM = 0.01;
// A lifetime beyond this is for ever.
constexpr double kLongestLifetimeS = 1e9;

bool is_finite(const Detection& detection) {
  return detection.centre_W.allFinite() && std::isfinite(detection.depth_sigma_m) &&
         std::isfinite(detection.size_m) &&
         std::all_of(detection.p_W.begin(), detection.p_W.end(),
                     [](const Eigen::Vector3d& p) { return p.allFinite(); });
}

}  // namespace

TrackedObstacle known_obstacle(int id, TimeUs t_us, const Eigen::Vector3d& p_WO,
                               const Eigen::Vector3d& v_WO, double size_m) {
  TrackedObstacle known;
  known.obstacle = {id, t_us, t_us, 1, p_WO, v_WO, size_m};
  known.ellipsoid = sphere(p_WO, 0.5 * size_m);
  known.confirmed = true;
  return known;
}

Tracker::Tracker(const AssociationConfig& association, const KalmanConfig& kalman,
                 double lifetime_s)
    : association_(association), kalman_(kalman), associator_(association) {
  if (!(lifetime_s >= 0)) {
    throw std::invalid_argument("The lifetime of an obstacle must not be negative.");
  }
  lifetime_us_ = static_cast<TimeUs>(std::min(lifetime_s, kLongestLifetimeS) * kUsPerSecond);
  tracks_.reserve(kUsualObstacles);
  measured_.reserve(kUsualObstacles);
  predicted_.reserve(4 * kUsualObstacles);  // as many pairs as the associator has room for
  obstacles_.reserve(kUsualObstacles);
}

void Tracker::predict(TimeUs now_us) {
  remove_stale(now_us);
  publish(now_us);
}

PredictedObstacle Tracker::predicted(const Track& track, TimeUs t_us) {
  const Kalman::Position position = track.filter.position_at(t_us);
  const TimeUs unseen_us = std::max<TimeUs>(0, t_us - track.last_detection_us);
  return {position.mean_W, position.covariance_W, track.detections, seconds(unseen_us)};
}

// In one look an obstacle is detected at most once, so that each detection has a track of its own.
// Those that are not finite are left out before, and take no track from the others.
void Tracker::update(TimeUs now_us, std::span<Detection> detections) {
  remove_stale(now_us);
  for (Track& track : tracks_) track.missed = true;
  predicted_.clear();
  measured_.clear();
  for (const Detection& detection : detections) {
    if (!is_finite(detection)) continue;
    measured_.push_back({detection.centre_W, measurement_covariance(kalman_, detection)});
    for (const Track& track : tracks_) predicted_.push_back(predicted(track, detection.t_us));
  }
  const std::span<const int> track_of = associator_.associate(measured_, predicted_);
  std::size_t next = 0;
  for (Detection& detection : detections) {
    detection.obstacle_id = -1;
    if (!is_finite(detection)) continue;
    const std::size_t i = next++;
    const Eigen::Matrix3d& R = measured_[i].R_W;
    if (track_of[i] < 0) {
      tracks_.push_back(
          {next_id_++, Kalman(kalman_, detection.t_us, detection.centre_W, R), detection.t_us});
      measure(tracks_.back(), detection);
    } else {
      Track& track = tracks_[static_cast<std::size_t>(track_of[i])];
      track.filter.update(detection.t_us, detection.centre_W, R);
      measure(track, detection);
    }
  }
  publish(now_us);
}

void Tracker::measure(Track& track, Detection& detection) const {
  detection.obstacle_id = track.id;
  track.missed = false;
  track.last_detection_us = std::max(track.last_detection_us, detection.t_us);
  track.size_m = detection.size_m;
  track.ellipsoid = minimum_volume_ellipsoid(detection.p_W, kMinHalfWidthM);
  track.ellipsoid.centre_W -= detection.centre_W;
  ++track.detections;
  track.confirmed |= track.detections >= association_.min_detections;
}

void Tracker::remove_stale(TimeUs now_us) {
  std::erase_if(tracks_, [&](const Track& track) {
    const TimeUs allowed = track.confirmed || !track.missed
                               ? lifetime_us_
                               : std::min(lifetime_us_, association_.tentative_timeout_us);
    const TimeUs unseen_us = now_us - track.last_detection_us;
    return unseen_us > allowed || unseen_us < 0;  // negative: the clock was set back
  });
}

void Tracker::publish(TimeUs now_us) {
  obstacles_.clear();
  for (const Track& track : tracks_) {
    Kalman filter = track.filter;
    filter.predict(now_us);
    TrackedObstacle& tracked = obstacles_.emplace_back();
    tracked.obstacle = {track.id,         filter.t_us(),     track.last_detection_us,
                        track.detections, filter.position(), filter.velocity(),
                        track.size_m};
    tracked.covariance = filter.covariance();
    tracked.ellipsoid = track.ellipsoid;
    tracked.ellipsoid.centre_W += filter.position();
    tracked.confirmed = track.confirmed;
  }
}

}  // namespace dodge
