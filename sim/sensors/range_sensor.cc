#include "sim/sensors/range_sensor.h"

#include <algorithm>
#include <cmath>

namespace dodgesim {

std::optional<RangeReading> RangeSensor::sample(TimeUs t_us, double true_range_m) {
  // Drawn even if there is no reading, so that the noise of later readings does not shift.
  const double noise = random_.normal();
  if (!(true_range_m >= spec_.min_range_m && true_range_m <= spec_.max_range_m)) {
    return std::nullopt;
  }
  const bool far = true_range_m > spec_.fraction_from_m;
  const double sigma = far ? spec_.sigma_fraction * true_range_m : spec_.sigma_m;
  double range = std::max(0.0, true_range_m + sigma * noise);
  if (spec_.resolution_m > 0) range = std::round(range / spec_.resolution_m) * spec_.resolution_m;
  return RangeReading{t_us, range};
}

}  // namespace dodgesim
