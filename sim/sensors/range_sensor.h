// The distance sensor that looks down.
#pragma once

#include <optional>

#include "sim/base/random.h"
#include "sim/sensors/readings.h"
#include "sim/sensors/sample_clock.h"

namespace dodgesim {

// Defaults: Terabee TeraRanger Evo 60m (paper, supplementary), from its data sheet.
struct RangeSpec {
  int rate_hz = 200;
  double sigma_m = 0.02;
  double sigma_fraction = 0.0075;
  double fraction_from_m = 14;
  double resolution_m = 0.005;
  double min_range_m = 0.5;
  double max_range_m = 60;

  template <class Visitor>
  void visit(Visitor& v) {
    v("rate_hz", rate_hz, 1, 4000,
      "Readings per second; the sensor reaches 240, and the rate must divide 4000.");
    v("sigma_m", sigma_m, 0, 10,
      "Standard deviation of near readings: the stated accuracy of 4 cm read as two sigma.");
    v("sigma_fraction", sigma_fraction, 0, 1,
      "Standard deviation of far readings per metre of distance: the stated accuracy of 1.5 % read "
      "as two sigma.");
    v("fraction_from_m", fraction_from_m, 0, 1000,
      "Beyond it sigma_fraction holds, and sigma_m up to it.");
    v("resolution_m", resolution_m, 0, 1, "Step between two readings; 0 for none.");
    v("min_range_m", min_range_m, 0, 1000, "Nearer surfaces give no reading.");
    v("max_range_m", max_range_m, 0, 1000, "Farther surfaces give no reading.");
  }
};

class RangeSensor {
 public:
  // Throws ScenarioError if the rate does not fit the ticks.
  RangeSensor(const RangeSpec& spec, std::uint64_t seed, std::uint64_t throw_index)
      : spec_(spec), clock_(spec.rate_hz, "range sensor"), random_(seed, throw_index, "range") {}

  bool due(TimeUs t_us) const { return clock_.due(t_us); }

  // true_range_m: distance along -z of B to the first surface of the room or a thrown object;
  // infinite when there is none. Nothing when the distance is out of range.
  std::optional<RangeReading> sample(TimeUs t_us, double true_range_m);

 private:
  RangeSpec spec_;
  SampleClock clock_;
  RandomStream random_;
};

}  // namespace dodgesim
