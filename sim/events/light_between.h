// What pixels see between two pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/time.h"
#include "sim/events/response.h"
#include "sim/events/spec.h"

namespace dodgesim {

// The time between two pictures in steps. A camera with noise makes events all the time, however
// little there is to see: whoever shows it pictures that are far apart shows it these in between,
// so that memory need not hold more than the events of a step.
class LightBetween {
 public:
  static constexpr TimeUs kLongestStepUs = 50000;

  explicit LightBetween(const EventCameraSpec& spec);

  // Steps of a time, of about the same length; without noise one.
  std::int64_t steps(TimeUs interval_us) const;

  // The luminance of every pixel after a share, from 0 to 1, of the time from one picture to the
  // next: its response runs linearly. Where nothing changes it stays what it is.
  void at(double share, const std::vector<float>& before, const std::vector<float>& after,
          std::vector<float>& between) const;

 private:
  Response response_;
  bool noisy_;
};

}  // namespace dodgesim
