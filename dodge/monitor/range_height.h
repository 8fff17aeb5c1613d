// Height above the ground by the range sensor that looks down (Falanga et al. 2020, "Hardware").
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "dodge/types.h"

namespace dodge {

struct RangeSensorConfig {
  double min_range_m = 0.5;
  double max_range_m = 60;
  double max_tilt_deg = 30;

  template <class Visitor>
  void visit(Visitor& v) {
    v("min_range_m", min_range_m, 0.0, 1000.0,
      "Readings nearer than this are not used (TeraRanger Evo 60m: 0.5 m).");
    v("max_range_m", max_range_m, 0.0, 1000.0,
      "Readings farther than this are not used (TeraRanger Evo 60m: 60 m).");
    v("max_tilt_deg", max_tilt_deg, 1.0, 80.0,
      "Readings at more tilt are not used: the sensor then looks at what is beside the vehicle, at "
      "30 deg 1.2 m away from 2 m up, and an error of the attitude weighs more.");
  }
};

// Height of B's origin above the flat ground that a reading saw [m], with the tilt of `state`, the
// estimate of the reading's instant. p_BR: where the sensor sits; it looks along -z of B. Nothing
// if reading or state are not finite, the range is out of its limits or the tilt too large.
std::optional<double> height_above_ground(const RangeSensorConfig& config,
                                          const Eigen::Vector3d& p_BR, const RangeReading& reading,
                                          const StateEstimate& state);

}  // namespace dodge
