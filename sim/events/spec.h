// Parameters of the event camera and of the instants at which it is sampled.
#pragma once

#include <cstdint>

namespace dodgesim {

struct EventCameraSpec {
  double contrast_threshold_on = 0.2;
  double contrast_threshold_off = 0.2;
  double mismatch_sigma = 0.03;
  double threshold_min = 0.01;
  double log_epsilon = 1e-3;
  std::int64_t refractory_us = 100;
  double background_on_hz = 0.235;
  double background_off_hz = 0.200;
  double hot_pixel_fraction = 0.0007;
  double hot_pixel_hz = 157;

  template <class Visitor>
  void visit(Visitor& v) {
    v("contrast_threshold_on", contrast_threshold_on, 0.01, 10,
      "Change of log luminance that makes an ON event (v2e and vid2e: 0.2).");
    v("contrast_threshold_off", contrast_threshold_off, 0.01, 10,
      "Change of log luminance that makes an OFF event (v2e and vid2e: 0.2).");
    v("mismatch_sigma", mismatch_sigma, 0, 1,
      "Standard deviation of the thresholds over the pixels, each polarity by itself (v2e: 0.03).");
    v("threshold_min", threshold_min, 1e-3, 10,
      "Lowest threshold that mismatch may leave to a pixel (v2e: 0.01).");
    v("log_epsilon", log_epsilon, 1e-9, 1e3,
      "Luminance added before the logarithm; keeps black finite (ESIM: 0.001).");
    v("refractory_us", refractory_us, 0, 1000000,
      "Time a pixel is held in reset after an event (most simulators: 100 us, v2e: 500 us).");
    v("background_on_hz", background_on_hz, 0, 1000,
      "Rate of background ON events of every pixel (measured on a DVXplorer at rest).");
    v("background_off_hz", background_off_hz, 0, 1000,
      "Rate of background OFF events of every pixel (measured on a DVXplorer at rest).");
    v("hot_pixel_fraction", hot_pixel_fraction, 0, 1,
      "Share of the pixels that are hot (measured on a DVXplorer).");
    v("hot_pixel_hz", hot_pixel_hz, 0, 100000,
      "Rate a hot pixel adds to the background (DVXplorer: hot pixels carry 20 % of it).");
  }
};

// Events are exactly the crossings of log luminance: no mismatch, no refractory period, no noise.
inline EventCameraSpec ideal_event_camera() {
  EventCameraSpec spec;
  spec.mismatch_sigma = 0;
  spec.refractory_us = 0;
  spec.background_on_hz = 0;
  spec.background_off_hz = 0;
  spec.hot_pixel_fraction = 0;
  return spec;
}

struct SamplingSpec {
  double max_displacement_px = 0.5;
  double fast_displacement_px = 1.0;
  std::int64_t fast_interval_us = 500;
  double min_rate_hz = 200;
  std::int64_t min_interval_us = 250;

  template <class Visitor>
  void visit(Visitor& v) {
    v("max_displacement_px", max_displacement_px, 0.01, 100,
      "Nothing in the image moves farther than this between two samples (0.5 px loses 0.6 % of the "
      "events of a texture of 8 px wavelength, 1 px 2.3 %).");
    v("fast_displacement_px", fast_displacement_px, 0.01, 100,
      "The same limit where max_displacement_px would ask for samples less than fast_interval_us "
      "apart: time stamps are then precise anyway, and counts lose little.");
    v("fast_interval_us", fast_interval_us, 1, 1000000,
      "Interval below which fast_displacement_px counts; 0.5 ms keep time stamps within 0.1 ms.");
    v("min_rate_hz", min_rate_hz, 1, 4000,
      "Rate of the samples of the whole image when nothing moves; its inverse bounds how late an "
      "event is known.");
    v("min_interval_us", min_interval_us, 1, 1000000,
      "Shortest time between two samples of the same object or of the room, which bounds the cost "
      "of an object that fills the view. With 250 us and 1 px (fast_displacement_px) it leaves an "
      "object under-sampled only while it moves faster than 4000 px/s, that is when it passes "
      "within about half a metre.");
  }
};

}  // namespace dodgesim
