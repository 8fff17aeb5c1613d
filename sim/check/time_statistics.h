// Time statistics of the events of static and dynamic regions, after the caption of figure S2 of
// Falanga et al. 2020: what lets the detection tell what moves by itself from what the camera's own
// motion moves. From one throw of a scenario, flown by the paper's pilot; regions are told apart by
// the true cause of every event.
#pragma once

#include <vector>

#include "sim/check/check.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// A pixel of a compensated window of the top camera.
struct PixelTime {
  double rho = 0;       // normalised mean time stamp (4)
  double averaged = 0;  // the same after the pilot's averaging
};

struct TimeStatistics {
  // Pixels that only the static scene fired, and that only the object fired.
  struct Regions {
    std::vector<PixelTime> fixed, dynamic;
  };
  Regions hovering, evading;  // until the vehicle evades, and from then on
  double threshold = 0;       // of the pilot, of a camera at rest
};

// Flies throw `throw_index` until the object arrives. The pilot must be falanga2020.
TimeStatistics measure_time_statistics(const Scenario& scenario, int throw_index);

Check judge(const TimeStatistics& statistics);

}  // namespace dodgesim
