#include "dodge/dodger.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace dodge {

namespace {

const Config& validated(const Config& config) {
  validate(config);
  return config;
}

// Adds the time since the last call to a stage's sum.
class Stopwatch {
 public:
  void add_to(double& sum_us) {
    const auto now = std::chrono::steady_clock::now();
    sum_us += std::chrono::duration<double, std::micro>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

Dodger::Eye::Eye(const Config& config, const CameraModel& camera)
    : R_CB(camera.X_BC.linear().transpose()),
      ego_motion(config.ego_motion, camera),
      time_image(config.time_image, camera.width, camera.height),
      flow(config.flow),
      clusterer(config.cluster, camera.width, camera.height) {}

Dodger::Dodger(const Config& config)
    : config_(validated(config)),
      depth_(config.position, config.cameras, config.window.window_us, config.cluster.max_groups),
      tracker_(config.association, config.kalman, decay_lifetime_s(config.repulsive)),
      avoider_(config.repulsive, config.attractive, config.velocity_limit, config.escape),
      height_monitor_(config.height_monitor),
      landing_(config.landing) {
  const std::size_t used = config.position.cameras();
  eyes_.reserve(used);  // copies of an eye would not keep the room that it has reserved
  for (std::size_t i = 0; i < used; ++i) eyes_.emplace_back(config_, config_.cameras[i]);
  for (const Eye& eye : eyes_)
    views_.push_back({&eye.clusterer.clusters(), &eye.time_image.averaged()});
  detections_.reserve(static_cast<std::size_t>(config.cluster.max_groups));
  obstacles_.reserve(Tracker::kUsualObstacles);
}

void Dodger::add_events(int camera, std::span<const Event> events) {
  const auto index = static_cast<std::size_t>(camera);
  if (index < eyes_.size()) eyes_[index].events.add(events);
}

void Dodger::add_range(const RangeReading& reading) {
  const std::optional<StateEstimate> state = states_.at(reading.t_us);
  if (!state) return;
  const std::optional<double> height_m =
      height_above_ground(config_.range_sensor, config_.p_BR, reading, *state);
  if (!height_m) return;
  height_monitor_.add(reading.t_us, state->p_WB.z(), *height_m);
  landing_.add(reading.t_us, state->p_WB.z(), *height_m);
}

void Dodger::set_goal(const Goal& goal) {
  if (!goal.p_WG.allFinite() || !std::isfinite(goal.speed_mps)) return;
  goal_ = goal;
  has_goal_ = true;
}

VelocityCommand Dodger::update(TimeUs now_us) {
  stage_times_ = {};
  detections_.clear();
  move_window(now_us);
  for (Eye& eye : eyes_) find_clusters(eye);

  Stopwatch watch;
  if (locate_obstacles()) {
    tracker_.update(now_us, detections_);
  } else {
    tracker_.predict(now_us);
  }
  VelocityCommand command = decide(now_us);
  command.t_us = end_us_;
  obstacles_.clear();
  for (const TrackedObstacle& tracked : tracker_.obstacles())
    obstacles_.push_back(tracked.obstacle);
  watch.add_to(stage_times_.rest_us);
  return command;
}

VelocityCommand Dodger::decide(TimeUs now_us) {
  if (config_.height_monitor.enabled && height_monitor_.drifted()) return landing_.command(now_us);
  const std::optional<StateEstimate> state = states_.at(now_us);
  if (!state) return {};
  const Goal stay{.p_WG = state->p_WB};
  return avoider_.command(now_us, *state, has_goal_ ? goal_ : stay, tracker_.obstacles());
}

// The window ends where every camera's events have arrived, so that it is full whatever the
// cameras' delay; a camera that is silent holds it up for a moment only, and in silence it moves on
// with the clock.
TimeUs Dodger::window_end(TimeUs now_us) const {
  const TimeUs earliest_us = now_us - config_.window.event_timeout_us;
  TimeUs all_us = now_us, any_us = earliest_us;
  for (const Eye& eye : eyes_) {
    const TimeUs newest_us = std::min(eye.events.last_taken_us().value_or(earliest_us), now_us);
    all_us = std::min(all_us, newest_us);
    any_us = std::max(any_us, newest_us);
  }
  return std::max({all_us, any_us - config_.window.camera_lag_us, earliest_us});
}

void Dodger::move_window(TimeUs now_us) {
  for (Eye& eye : eyes_) eye.events.take(now_us + kMostAheadUs);
  const TimeUs end_us = window_end(now_us);
  elapsed_windows_ = started_ ? static_cast<double>(end_us - end_us_) /
                                    static_cast<double>(config_.window.window_us)
                              : 0;
  started_ = true;
  end_us_ = end_us;
  begin_us_ = end_us - config_.window.window_us;
  for (Eye& eye : eyes_) eye.events.forget_until(begin_us_);
}

// A rate from before the window would compensate for a turn that may long be over.
Eigen::Vector3d Dodger::mean_rate() const {
  const bool silent = rates_.newest_us().value_or(begin_us_) <= begin_us_;
  const bool newer = states_.newest_us().value_or(begin_us_) > begin_us_;
  return silent && newer ? states_.at(end_us_)->w_WB_B : rates_.mean(begin_us_, end_us_);
}

void Dodger::find_clusters(Eye& eye) {
  Stopwatch watch;
  const Eigen::Vector3d w_WC_C = eye.R_CB * mean_rate();
  eye.ego_motion.set_motion(w_WC_C, begin_us_, end_us_);
  eye.time_image.accumulate(eye.events.until(end_us_), eye.ego_motion, begin_us_, end_us_);
  watch.add_to(stage_times_.ego_motion_us);

  eye.time_image.threshold(w_WC_C.norm());
  watch.add_to(stage_times_.threshold_us);

  eye.time_image.clean();
  watch.add_to(stage_times_.morphology_us);

  eye.flow.set_images(eye.time_image.previous_averaged(), eye.time_image.averaged(),
                      elapsed_windows_);
  eye.clusterer.find(eye.time_image, eye.flow);
  watch.add_to(stage_times_.clustering_us);

  if (capture_) capture_images(eye);
}

bool Dodger::locate_obstacles() {
  if (elapsed_windows_ <= 0) return false;  // the same data again are no new measurement
  std::optional<StateEstimate> state = states_.at(end_us_);
  if (!state) return false;
  if (config_.ego_motion.reference == "start") {
    // The pixels show what the cameras saw as they were turned then.
    const std::optional<StateEstimate> start = states_.at(begin_us_);
    if (!start) return false;
    state->q_WB = start->q_WB;
  }
  depth_.locate(views_, *state, detections_);
  return true;
}

const Dodger::Eye* Dodger::eye(int camera) const {
  const auto index = static_cast<std::size_t>(camera);
  return index < eyes_.size() ? &eyes_[index] : nullptr;
}

std::optional<TimeUs> Dodger::newest_event_us(int camera) const {
  const Eye* const seeing = eye(camera);
  return seeing != nullptr ? seeing->events.last_taken_us() : std::nullopt;
}

std::int64_t Dodger::dropped_events(int camera) const {
  const Eye* const seeing = eye(camera);
  return seeing != nullptr ? seeing->events.dropped() : 0;
}

const std::vector<Cluster>& Dodger::clusters(int camera) const {
  static const std::vector<Cluster> none;
  const Eye* const seeing = eye(camera);
  return seeing != nullptr ? seeing->clusterer.clusters() : none;
}

const StageImages& Dodger::stage_images(int camera) const {
  static const StageImages none;
  const Eye* const seeing = eye(camera);
  return seeing != nullptr ? seeing->images : none;
}

void Dodger::capture_images(Eye& eye) const {
  StageImages& images = eye.images;
  images.events.create(eye.time_image.count().size());
  images.events = 0;
  images.window.clear();
  for (const std::span<const Event> piece : eye.events.until(end_us_)) {
    for (const Event& event : piece) {
      images.window.push_back({event, compensated_pixel(eye.ego_motion, event, images.events.cols,
                                                        images.events.rows)});
      if (event.x >= images.events.cols || event.y >= images.events.rows) continue;
      images.events(event.y, event.x) = event.polarity > 0 ? 2 : 1;
    }
  }
  eye.time_image.count().copyTo(images.count);
  eye.time_image.rho().copyTo(images.rho);
  eye.time_image.averaged().copyTo(images.averaged);
  eye.time_image.threshold_mask().copyTo(images.threshold_mask);
  eye.time_image.obstacle_mask().copyTo(images.obstacle_mask);
}

}  // namespace dodge
