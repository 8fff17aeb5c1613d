#include "dodge/monitor/range_height.h"

#include <cmath>
#include <numbers>

namespace dodge {

std::optional<double> height_above_ground(const RangeSensorConfig& config,
                                          const Eigen::Vector3d& p_BR, const RangeReading& reading,
                                          const StateEstimate& state) {
  // Comparisons with NaN are false.
  if (!(reading.range_m >= config.min_range_m && reading.range_m <= config.max_range_m)) {
    return std::nullopt;
  }
  const Eigen::RowVector3d up_B = state.q_WB.normalized().toRotationMatrix().row(2);
  const double least_cos = std::cos(config.max_tilt_deg * std::numbers::pi / 180);
  if (!(up_B.z() >= least_cos) || !state.p_WB.allFinite()) return std::nullopt;
  return reading.range_m * up_B.z() - up_B.dot(p_BR);
}

}  // namespace dodge
