// What `dodgesim detect` says while it plays a recording and at its end.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dodge/monitor/range_height.h"
#include "sim/base/progress.h"
#include "sim/playback/camera_order.h"
#include "sim/playback/playback.h"
#include "sim/playback/rate_check.h"

namespace dodgesim {

// How far a recording has been played, by the size of its files, for a terminal.
class PlaybackProgress {
 public:
  explicit PlaybackProgress(const std::vector<std::string>& files);  // by camera

  void show(const Playback& playback);
  void finish() { progress_.finish(); }

 private:
  std::vector<std::int64_t> sizes_kb_;  // by camera
  Progress progress_;
};

// Says how much of the recording's time a log covers.
class Coverage {
 public:
  // `lacking`: what holds before its first reading, if something does.
  template <class Reading>
  Coverage(const char* name, const std::vector<Reading>& log, const char* lacking = "")
      : name_(name), lacking_(lacking) {
    for (const Reading& reading : log) stamps_us_.push_back(reading.t_us);
  }

  // Of a recording with events from begin_us to end_us.
  void report(TimeUs begin_us, TimeUs end_us, TimeUs period_us) const;

 private:
  const char* name_;
  const char* lacking_;
  std::vector<TimeUs> stamps_us_;
};

// Says whether a log's rates fit the events, and with which other axes or clock they would. `axes`:
// whose axes these are, as in "with AXES forward right down".
void report_rates(const char* log, const char* axes, const RateCheck::Fit& fit);

// Of a log that was given: says so if it has no reading that the pilot uses.
void report_ranges(const std::vector<RangeReading>& ranges, const dodge::RangeSensorConfig& config);

// Says so if the events of the first camera seem to be those of the lower one.
void report_order(const CameraOrder& order);

// Of rates that were taken for degrees a second: whether they make the events so much sharper that
// they must be; then it says so.
bool report_degrees(const char* log, const RateCheck::Fit& fit);

// What the cycles found, in sum.
class Sums {
 public:
  void add(int clusters, const Playback& playback);
  // After the last cycle.
  void report(const Playback& playback, int cameras, TimeUs period_us) const;

 private:
  long long cycles_ = 0, with_clusters_ = 0, with_detections_ = 0, detections_ = 0, evading_ = 0;
  long long landing_ = 0;
  TimeUs landing_since_us_ = 0;  // since the first event
  double stages_us_ = 0;         // wall clock
};

}  // namespace dodgesim
