#include "dodge/presets.h"

#include <stdexcept>

namespace dodge {

namespace {

Config dodgesim() {
  Config config;
  config.window.window_us = 20000;
  config.cluster.weight_position = 0.35;
  config.position.max_range_m = 5;
  config.association.gate_sigmas = 3;
  config.association.min_detections = 6;
  config.association.tentative_timeout_us = 100000;
  config.kalman.gravity = true;
  config.kalman.acceleration_noise = 1;
  config.kalman.lateral_size_share = 0.1;
  config.velocity_limit.calm_acceleration_mps2 = 3;
  config.escape.law = "closest_approach";
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
