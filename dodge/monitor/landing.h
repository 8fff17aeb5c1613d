// The emergency landing of a vehicle whose height estimate has drifted. It goes by the range sensor
// and dodges nobody: a dodge of several metres a second would rest on the estimate that has just
// proved wrong, near the ground.
#pragma once

#include <optional>

#include "dodge/types.h"

namespace dodge {

struct LandingConfig {
  double descent_mps = 0.8;
  double touchdown_mps = 0.3;
  double slow_below_m = 1.0;
  std::int64_t fresh_us = 100000;
  double drift_filter_s = 0.3;
  double max_step_m = 0.2;

  template <class Visitor>
  void visit(Visitor& v) {
    v("descent_mps", descent_mps, 0.05, 10.0, "Speed straight down, high above the ground.");
    v("touchdown_mps", touchdown_mps, 0.05, 5.0,
      "Speed near the ground and wherever the height is not known; at most descent_mps.");
    v("slow_below_m", slow_below_m, 0.0, 100.0,
      "Measured height below which the vehicle slows down; the sensor needs 0.5 m.");
    v("fresh_us", fresh_us, std::int64_t{1000}, std::int64_t{10000000},
      "The height is known for this long after a reading.");
    v("drift_filter_s", drift_filter_s, 0.01, 100.0,
      "Time constant of the filter that measures how fast the height estimate drifts. The command "
      "makes up for it, or an estimate that sinks faster than the vehicle should would make it "
      "climb.");
    v("max_step_m", max_step_m, 0.01, 100.0,
      "A reading farther than this from what the filter expects is a step of the ground, not "
      "drift.");
  }
};

class Landing {
 public:
  explicit Landing(const LandingConfig& config) : config_(config) {}

  // As HeightMonitor::add, from the start of the flight on.
  void add(TimeUs t_us, double estimated_m, double measured_m);

  // Straight down.
  VelocityCommand command(TimeUs now_us) const;

 private:
  LandingConfig config_;
  // Of the last reading; none before the first.
  std::optional<TimeUs> last_us_;
  double height_m_ = 0;
  // Second-order filter of the ground's height in the estimate, which a drift makes rise or sink.
  double ground_m_ = 0;
  double drift_mps_ = 0;  // how fast the height estimate rises against the range sensor
};

}  // namespace dodge
