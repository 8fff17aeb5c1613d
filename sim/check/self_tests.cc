#include "sim/check/self_tests.h"

#include "sim/check/conservation.h"
#include "sim/check/convergence.h"
#include "sim/check/far_frames.h"
#include "sim/check/noise_rates.h"
#include "sim/check/readout_burst.h"
#include "sim/check/refractory.h"
#include "sim/check/stamps.h"
#include "sim/check/step_response.h"
#include "sim/check/thresholds.h"

namespace dodgesim {

std::vector<std::function<Check()>> sensor_checks(const EventCameraSpec& camera,
                                                  std::uint64_t seed) {
  return {
      [=] { return judge(measure_conservation(camera, seed), camera); },
      [=] { return judge(measure_thresholds(camera, seed), camera); },
      [=] { return judge(measure_stamps(camera, seed)); },
      [=] { return judge(measure_ramp(camera, seed), camera); },
      [=] { return judge(measure_convergence(camera, seed)); },
      [=] { return judge(measure_far_frames(camera, seed)); },
      [=] { return judge(measure_step_response(camera, seed), camera); },
      [=] { return judge(measure_noise(camera, seed), camera); },
      [=] { return judge(measure_burst(camera, seed), camera); },
  };
}

}  // namespace dodgesim
