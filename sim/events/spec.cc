#include "sim/events/spec.h"

#include <stdexcept>

namespace dodgesim {

namespace {

EventCameraSpec ideal() {
  EventCameraSpec spec;
  spec.mismatch_sigma = 0;
  spec.photoreceptor_hz = 0;
  spec.refractory_us = 0;
  spec.leak_hz = 0;
  spec.shot_noise_on_hz = 0;
  spec.shot_noise_off_hz = 0;
  spec.hot_pixel_fraction = 0;
  spec.dead_pixel_fraction = 0;
  spec.latency_us = 0;
  spec.jitter_us = 0;
  spec.readout_max_hz = 0;
  return spec;
}

// About ten times the shot noise of a good camera, and a tenth of its speed.
EventCameraSpec noisy() {
  EventCameraSpec spec;
  spec.mismatch_sigma = 0.05;       // assumed
  spec.photoreceptor_hz = 300;      // assumed
  spec.photoreceptor_dark_hz = 30;  // assumed: that of white in v2e's noisy camera
  spec.refractory_us = 500;         // v2e's default
  spec.leak_hz = 0.2;               // assumed
  spec.shot_noise_on_hz = 2.5;      // v2e: 5 Hz of both polarities
  spec.shot_noise_off_hz = 2.5;
  spec.hot_pixel_fraction = 0.0012;  // measured on a VGA-lite sensor
  spec.dead_pixel_fraction = 0.001;  // assumed
  spec.jitter_us = 50;               // assumed
  return spec;
}

EventCameraSpec low_light() {
  EventCameraSpec spec;
  spec.illuminance_lux = 5;  // assumed: a street at night; a hundredth of an office
  return spec;
}

}  // namespace

EventCameraSpec event_camera_preset(const std::string& name) {
  EventCameraSpec spec;
  if (name == "ideal") {
    spec = ideal();
  } else if (name == "noisy") {
    spec = noisy();
  } else if (name == "low_light") {
    spec = low_light();
  } else if (name != "sees1") {
    throw std::invalid_argument("There is no event camera preset " + name + ".");
  }
  spec.preset = name;
  return spec;
}

}  // namespace dodgesim
