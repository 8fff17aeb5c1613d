// Whether the state estimate drifts in height: Falanga et al. 2020, "Hardware": "Whenever we detect
// a discrepancy [with the range sensor] beyond a manually defined threshold, the quadrotor
// automatically executes an emergency landing maneuver."
#pragma once

#include <optional>
#include <vector>

#include "dodge/types.h"

namespace dodge {

struct HeightMonitorConfig {
  bool enabled = true;
  double threshold_m = 0.3;
  std::int64_t persist_us = 300000;
  std::int64_t max_gap_us = 50000;
  int learn_readings = 41;

  template <class Visitor>
  void visit(Visitor& v) {
    v("enabled", enabled, "Whether the vehicle lands when its height estimate has drifted.");
    v("threshold_m", threshold_m, 0.01, 100.0,
      "Discrepancy between estimated and measured height beyond which the estimate has drifted. "
      "The paper sets it by hand and does not give it. Nothing lands in a hover 2 m high "
      "(scenarios/quiet_hover.yaml) or 10 m high over the field; above 14 m the sensor's noise "
      "grows with the height.");
    v("persist_us", persist_us, std::int64_t{0}, std::int64_t{60000000},
      "How long the discrepancy must last without a break: longer than a ball passes below the "
      "vehicle, or an outlier.");
    v("max_gap_us", max_gap_us, std::int64_t{1000}, std::int64_t{60000000},
      "A pause this long between two readings that can be used is a break, too: in a dodge the "
      "tilt makes them useless.");
    v("learn_readings", learn_readings, 1, 10000,
      "The first readings, whose median says how high the ground is: a wrong height at the start "
      "is no drift.");
  }
};

// The ground is taken for flat, as the paper's vehicle must take it: what stays below the vehicle
// for longer than persist_us and is higher than threshold_m, a table say, looks like drift.
class HeightMonitor {
 public:
  explicit HeightMonitor(const HeightMonitorConfig& config);

  // Estimated height in W and height above the ground by the range sensor at one instant. Call in
  // ascending time; one that goes back is a break.
  void add(TimeUs t_us, double estimated_m, double measured_m);

  // The estimate has drifted; once true it stays true.
  bool drifted() const { return drifted_; }

 private:
  void learn(double ground_m);

  HeightMonitorConfig config_;
  std::vector<double> first_grounds_m_;
  std::optional<double> ground_m_;  // in W, where the estimate put it at the start
  std::optional<TimeUs> apart_since_us_;
  TimeUs last_us_ = 0;
  bool drifted_ = false;
};

}  // namespace dodge
