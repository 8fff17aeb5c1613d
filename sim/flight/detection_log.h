// What the pilot detects, with the truth beside it.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "dodge/types.h"
#include "sim/bridge/delay_line.h"
#include "sim/outcome/result.h"
#include "sim/world/world.h"

namespace dodgesim {

// A detection nearer than this to the centre of an object of that radius is one of it.
inline double true_detection_m(double radius_m) { return std::max(0.5, radius_m + 0.35); }

// All detections of a flight.
struct DetectionLog {
  // The first one of an object.
  struct First {
    TimeUs output_us = 0;
    TimeUs t_us = 0;        // the instant it speaks of
    double distance_m = 0;  // true distance object to camera then
    int object = 0;
  };
  std::vector<DetectionRow> rows;                     // in the order of their outputs
  std::optional<First> first;                         // of any object
  std::vector<std::optional<First>> first_of_object;  // by object
};

// A pilot finds detections when a cycle starts and gives them out when it is over: until then the
// flight may end, and they are not logged.
class DetectionLogger {
 public:
  // output_delay_us: from the start of a cycle of the pilot to its output.
  DetectionLogger(const World& world, TimeUs output_delay_us);

  // Call after each tick.
  void observe(const Snapshot& now) { history_.add(now); }

  // Of the pilot's cycle that starts now, in the frame of its state estimates, which has drifted by
  // drift_W [m] and in which the truth is put beside them. Returns whether it is the first to
  // detect an object.
  bool find(TimeUs now_us, std::span<const dodge::Detection> detections,
            const Eigen::Vector3d& drift_W);

  // Logs what the pilot has given out by now, and calls logged(row, true_object) for each:
  // true_object says whether the detection is one of row.object.
  template <class Logged>
  void log_outputs(TimeUs now_us, Logged logged) {
    found_.deliver(now_us, [&](const Found& found) {
      add(found);
      logged(found.row, found.true_object);
    });
  }

  const DetectionLog& log() const { return log_; }

 private:
  struct Found {
    DetectionRow row;
    bool true_object = false;
    double distance_m = 0;  // of that object, from the camera
  };

  Found with_truth(const dodge::Detection& detection, const Eigen::Vector3d& drift_W,
                   DetectionRow row) const;
  void add(const Found& found);

  const World& world_;
  TimeUs output_delay_us_;
  SnapshotHistory history_;  // for the truth at the instant of a detection
  DelayLine<Found> found_;   // until the pilot gives them out
  bool found_object_ = false;
  DetectionLog log_;
};

}  // namespace dodgesim
