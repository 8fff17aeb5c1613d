#include "dodge/monitor/height_monitor.h"

#include <algorithm>
#include <cmath>

namespace dodge {

HeightMonitor::HeightMonitor(const HeightMonitorConfig& config) : config_(config) {
  first_grounds_m_.reserve(static_cast<std::size_t>(config.learn_readings));
}

void HeightMonitor::add(TimeUs t_us, double estimated_m, double measured_m) {
  const double ground_m = estimated_m - measured_m;
  if (!ground_m_) return learn(ground_m);
  if (std::abs(ground_m - *ground_m_) <= config_.threshold_m) {
    apart_since_us_.reset();
  } else {
    const TimeUs passed_us = t_us - last_us_;
    const bool goes_on = passed_us >= 0 && passed_us <= config_.max_gap_us;
    if (!apart_since_us_ || !goes_on) apart_since_us_ = t_us;
    if (t_us - *apart_since_us_ >= config_.persist_us) drifted_ = true;
  }
  last_us_ = t_us;
}

void HeightMonitor::learn(double ground_m) {
  first_grounds_m_.push_back(ground_m);
  if (first_grounds_m_.size() < static_cast<std::size_t>(config_.learn_readings)) return;
  const auto middle =
      first_grounds_m_.begin() + static_cast<std::ptrdiff_t>(first_grounds_m_.size() / 2);
  std::nth_element(first_grounds_m_.begin(), middle, first_grounds_m_.end());
  ground_m_ = *middle;
}

}  // namespace dodge
