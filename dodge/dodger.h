// The paper's pilot: Falanga, Kleber, Scaramuzza, "Dynamic obstacle avoidance for quadrotors with
// event cameras", Science Robotics 2020. Events and angular rates in, a velocity command out; or,
// once the range sensor says that the height estimate has drifted, an emergency landing.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "dodge/avoid/avoider.h"
#include "dodge/config.h"
#include "dodge/detect/cluster.h"
#include "dodge/detect/depth.h"
#include "dodge/detect/ego_motion.h"
#include "dodge/detect/event_window.h"
#include "dodge/detect/optical_flow.h"
#include "dodge/detect/time_image.h"
#include "dodge/detect/tracker.h"
#include "dodge/history.h"
#include "dodge/monitor/height_monitor.h"
#include "dodge/monitor/landing.h"
#include "dodge/pilot.h"

namespace dodge {

// Wall-clock times of the last update [us], all cameras together, in the terms of the paper's
// Table 3. For reports only: no result depends on them.
struct StageTimes {
  double ego_motion_us = 0;  // compensation, event count and time image
  double threshold_us = 0;   // normalised mean time stamp, averaging, cut
  double morphology_us = 0;
  double clustering_us = 0;  // optical flow, pre-clusters, DBSCAN
  double rest_us = 0;        // depth, tracking, avoidance
};

struct CompensatedEvent {
  Event event;
  int pixel = -1;  // where it is after compensation, y * width + x; -1: outside of the image
};

// What one camera's stages saw in the last update: panels B to F of the paper's Fig. 4.
struct StageImages {
  cv::Mat1b events;          // B: not compensated; 0 none, 1 darker last, 2 brighter last
  cv::Mat1w count;           // C: compensated events per pixel
  cv::Mat1f rho;             // D: normalised mean time stamp, 0 where there is no event
  cv::Mat1f averaged;        //    the same after averaging
  cv::Mat1b threshold_mask;  // E: 0 or 255
  cv::Mat1b obstacle_mask;   // F: after morphology, 0 or 255
  std::vector<CompensatedEvent> window;  // the events of B and C, oldest first
};

class Dodger : public Pilot {
 public:
  // Throws std::invalid_argument (see validate()).
  explicit Dodger(const Config& config);
  Dodger(const Dodger&) = delete;
  Dodger& operator=(const Dodger&) = delete;

  void add_events(int camera, std::span<const Event> events) override;
  void add_imu(const ImuSample& sample) override { rates_.add(sample); }
  void add_state(const StateEstimate& state) override { states_.add(state); }
  void add_range(const RangeReading& reading) override;
  void set_goal(const Goal& goal) override;  // one that is not finite is none

  // Until the first state estimate the command is zero. A landing, once begun, goes on for ever.
  // Neither this nor handing over data allocates memory, unless images are captured, or a window
  // has more events, or there are more obstacles, or more pairs of a detection and an obstacle,
  // than ever before and than memory is reserved for.
  VelocityCommand update(TimeUs now_us) override;

  std::span<const Detection> detections() const override { return detections_; }
  std::span<const Obstacle> obstacles() const override { return obstacles_; }

  // For whoever watches the sensors, since the start; of events, as of the last update. The pilot
  // flies on, whatever is missing: it gets nothing from a camera whose newest event is older than
  // window.window_us + window.event_timeout_us, nor, in stereo, from one that lags behind the other
  // by window.window_us + window.camera_lag_us or more (because its clock is behind, say), it
  // carries an old state on at constant velocity, and it takes the angular rate of the state
  // estimate when the IMU has said nothing since the window began. An event is dropped if it is
  // older than one before it that the window still holds, or more than kMostAheadUs later than the
  // update. When the clock is set back, what is later is forgotten. Nothing for a camera that is
  // not used.
  static constexpr TimeUs kMostAheadUs = 10000;
  std::optional<TimeUs> newest_event_us(int camera) const;
  std::optional<TimeUs> newest_imu_us() const { return rates_.newest_us(); }
  std::optional<TimeUs> newest_state_us() const { return states_.newest_us(); }
  std::int64_t dropped_events(int camera) const;

  // Of the last update. Cameras that the configuration does not use (mono) have no clusters.
  const std::vector<Cluster>& clusters(int camera) const;
  const StageTimes& stage_times() const { return stage_times_; }

  // Whether the stages' images are kept from the next update on. Those of an update are valid until
  // the one after it.
  void set_capture(bool capture) { capture_ = capture; }
  const StageImages& stage_images(int camera) const;

 private:
  // The stages of one camera, each reusing its memory.
  struct Eye {
    Eye(const Config& config, const CameraModel& camera);

    Eigen::Matrix3d R_CB;
    EventWindow events;
    EgoMotion ego_motion;
    TimeImage time_image;
    OpticalFlow flow;
    Clusterer clusterer;
    StageImages images;
  };

  const Eye* eye(int camera) const;  // none for a camera that is not used
  TimeUs window_end(TimeUs now_us) const;
  void move_window(TimeUs now_us);
  Eigen::Vector3d mean_rate() const;  // of B in the window, in B
  void find_clusters(Eye& eye);
  bool locate_obstacles();  // false without new events or a state estimate
  VelocityCommand decide(TimeUs now_us);
  void capture_images(Eye& eye) const;

  Config config_;
  std::vector<Eye> eyes_;    // the cameras in use
  std::vector<View> views_;  // of the cameras in use
  RateHistory rates_;
  StateHistory states_;
  Goal goal_;
  bool has_goal_ = false;
  DepthEstimator depth_;
  Tracker tracker_;
  Avoider avoider_;
  HeightMonitor height_monitor_;
  Landing landing_;

  TimeUs begin_us_ = 0, end_us_ = 0;  // the window is (begin_us_, end_us_]
  double elapsed_windows_ = 0;        // between the last two windows; 0: no new data
  bool started_ = false;
  std::vector<Detection> detections_;
  std::vector<Obstacle> obstacles_;
  StageTimes stage_times_;
  bool capture_ = false;
};

}  // namespace dodge
