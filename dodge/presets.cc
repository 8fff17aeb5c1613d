#include "dodge/presets.h"

#include <stdexcept>

namespace dodge {

namespace {

Config dodgesim() {
  Config config;
  // Enough events of a ball of 10 cm at 3 m.
  config.window.window_us = 20000;
  // Clusters over 20 instead of 35 px: a ball seldom grows together with its background.
  config.cluster.weight_position_1ppx = 0.35;
  // What moves of a thin object is a line, and so is an edge of the background. But where the
  // other camera's picture of it is taken for another edge's, a better match mostly lies elsewhere,
  // and the mistake seldom comes again within 60 ms.
  config.cluster.max_aspect = 8;
  config.position.stereo.min_share_of_best = 0.9;
  // Far away, but only what was detected eight times, each time within three standard deviations of
  // where free fall from the detections before puts it. That takes some 30 ms, longer than a
  // window, so that the first and the last share no events. In so short a time free fall tells what
  // jumps, not what flies straight or upwards.
  config.position.max_range_m = 5;
  config.association.gate_sigmas = 3;
  config.association.min_detections = 8;
  config.association.tentative_timeout_us = 60000;
  config.kalman.gravity = true;
  config.kalman.acceleration_noise_mps2_sqrthz = 1;
  // A wide cluster tells less of where its object is.
  config.kalman.lateral_size_share = 0.1;
  // Tilted at 45 degrees and turning it would see the next object late.
  config.velocity_limit.calm_acceleration_mps2 = 3;
  config.escape.law = "closest_approach";
  // The background seldom seems to be faster.
  config.escape.min_speed_mps = 2.5;
  return config;
}

}  // namespace

Config preset(const std::string& pilot) {
  if (pilot == "falanga2020") return {};
  if (pilot == "dodgesim") return dodgesim();
  throw std::invalid_argument("There is no pilot " + pilot + ".");
}

}  // namespace dodge
