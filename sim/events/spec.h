// Parameters of the event camera and of the instants at which it is sampled.
#pragma once

#include <cstdint>
#include <string>

namespace dodgesim {

// At which the rates of noise and bandwidth are given.
inline constexpr double kBrightLux = 1000;

// The pixels and the readout of an event camera. Luminance is relative: 1 is a white surface under
// `illuminance_lux`. A value of 0 switches a part off unless its description says otherwise.
struct EventCameraSpec {
  std::string preset = "sees1";
  double contrast_threshold_on = 0.2;
  double contrast_threshold_off = 0.2;
  double mismatch_sigma = 0.03;
  double threshold_min = 0.01;
  double log_epsilon = 1e-3;
  double linear_below = 0;
  double illuminance_lux = 500;
  double photoreceptor_hz = 3000;
  double photoreceptor_dark_hz = 100;
  double follower_hz = 0;
  std::int64_t refractory_us = 100;
  double leak_hz = 0.1;
  double shot_noise_on_hz = 0.235;
  double shot_noise_off_hz = 0.200;
  double shot_noise_bright_share = 0.25;
  double hot_pixel_fraction = 0.0007;
  double hot_pixel_hz = 157;
  double hot_pixel_sigma = 1.05;
  double dead_pixel_fraction = 0.0001;
  std::string device = "campaign";
  std::int64_t latency_us = 100;
  double jitter_us = 10;
  double readout_max_hz = 2e7;
  std::int64_t stamp_resolution_us = 1;

  template <class Visitor>
  void visit(Visitor& v);

  // Names the random numbers that make a specimen of the camera.
  std::uint64_t device_index(std::uint64_t throw_index) const {
    return device == "throw" ? throw_index : 0;
  }
};

// The parameters of a preset by its name; throws std::invalid_argument for an unknown one.
//   sees1      the paper's camera, as far as it is known (the descriptions mark what is assumed)
//   ideal      events are exactly the crossings of log luminance: no mismatch, no bandwidth, no
//              refractory period, no noise, no latency, no limit of the readout
//   noisy      a worn or badly biased camera: shot noise of v2e's "noisy", slow pixels
//   low_light  the sees1 at 5 lux instead of 500
EventCameraSpec event_camera_preset(const std::string& name);

template <class Visitor>
void EventCameraSpec::visit(Visitor& v) {
  const std::string before = preset;
  v("preset", preset, {"sees1", "ideal", "noisy", "low_light"},
    "The camera from which the keys that are not given take their values. sees1: the defaults of "
    "these keys; the others are as sees1 but for what is named. ideal: events are the crossings of "
    "log luminance and nothing else, with mismatch_sigma 0, photoreceptor_hz 0, refractory_us 0, "
    "leak_hz 0, shot_noise_on_hz 0, shot_noise_off_hz 0, hot_pixel_fraction 0, "
    "dead_pixel_fraction 0, latency_us 0, jitter_us 0 and readout_max_hz 0. low_light: "
    "illuminance_lux 5 (a street at night; assumed), which makes slow pixels, about as slow as "
    "photoreceptor_dark_hz, and hardly more noise. noisy, a worn or badly biased camera: "
    "photoreceptor_hz 300 and photoreceptor_dark_hz 30 (assumed: of v2e's noisy camera white has a "
    "cut-off of 30 Hz and black one of 2), refractory_us 500 (v2e's default, not that of its noisy "
    "camera), shot_noise_on_hz 2.5 and shot_noise_off_hz 2.5 (v2e's noisy camera), "
    "hot_pixel_fraction 0.0012 (measured on a VGA-lite sensor), and mismatch_sigma 0.05, leak_hz "
    "0.2 (which so much shot noise hardly lets happen), dead_pixel_fraction 0.001 and jitter_us 50 "
    "(assumed).");
  if (preset != before) *this = event_camera_preset(preset);
  v("contrast_threshold_on", contrast_threshold_on, 0.01, 10,
    "Change of log luminance that makes an ON event (v2e and vid2e: 0.2).");
  v("contrast_threshold_off", contrast_threshold_off, 0.01, 10,
    "Change of log luminance that makes an OFF event (v2e and vid2e: 0.2).");
  v("mismatch_sigma", mismatch_sigma, 0, 1,
    "Standard deviation of the thresholds over the pixels, each polarity by itself (v2e: 0.03).");
  v("threshold_min", threshold_min, 1e-3, 0.01,
    "Lowest threshold that mismatch may leave to a pixel (v2e: 0.01).");
  v("log_epsilon", log_epsilon, 1e-9, 1e3,
    "Luminance added before the logarithm; keeps black finite (ESIM: 0.001).");
  v("linear_below", linear_below, 0, 1e3,
    "Luminance below which the response is linear instead of logarithmic, with the same slope "
    "there (v2e does so near black, with another slope). 0: logarithmic everywhere.");
  v("illuminance_lux", illuminance_lux, 1e-3, 2e5,
    "Illuminance of the scene: a white surface under it has luminance 1 (500: a lit office; "
    "assumed). It acts by the bandwidth and the rates of shot noise alone. The dark current, the "
    "loss of contrast due to it and the shot noise of the few photons below about a lux are not "
    "modelled: results below some lux mean little.");
  v("photoreceptor_hz", photoreceptor_hz, 0, 1e6,
    "What the cut-off of the photoreceptor's low-pass grows by where 1000 lux fall on white, in "
    "proportion to the light; photoreceptor_dark_hz is added (assumed: some kHz, as the DVS of "
    "Lichtsteiner et al. 2008). 0: no such low-pass, whatever photoreceptor_dark_hz is.");
  v("photoreceptor_dark_hz", photoreceptor_dark_hz, 0.01, 1e6,
    "Cut-off that is left in the dark, to which the light's is added (assumed). It alone decides "
    "how fast pixels are below some 30 lux: at 5 lux a pixel whose cut-off followed its "
    "photocurrent would be ten times slower. Signals are kept "
    "in single precision: below about 1 Hz what is sampled every few microseconds comes to rest "
    "too early.");
  v("follower_hz", follower_hz, 0, 1e6,
    "Cut-off of the source follower behind it, which does not depend on the light: both make "
    "the response second-order, which is followed to 0.5 % of the thresholds. Below about 1 Hz as "
    "photoreceptor_dark_hz. 0: no follower.");
  v("refractory_us", refractory_us, 0, 1000000,
    "Time a pixel is held in reset after an event (most simulators: 100 us, v2e: 500 us). It "
    "starts anew at its end, with the light of that instant for reference, as a pixel that is "
    "reset does: what changed meanwhile makes no event. Simulators that only leave out events of "
    "that time (ESIM) keep more.");
  v("leak_hz", leak_hz, 0, 1000,
    "Mean rate of ON events of a pixel at rest, due to the leak of its reference (v2e: 0.1), "
    "refractory periods not counted. Any "
    "other event of the pixel, of noise too, starts its leak anew, so with shot noise far fewer "
    "come: with that of sees1 about 0.01 Hz. With 0 the first frame sets the references. With any "
    "leak, however small, each starts below it, as after a long rest in that light: by a random "
    "share, from 0 to 1, of the pixel's ON threshold, the larger the more seldom if there is "
    "noise. So the first events, and with them those of a short film, are not those without a "
    "leak.");
  v("shot_noise_on_hz", shot_noise_on_hz, 0, 1000,
    "Mean rate of ON events of a pixel in the dark, due to shot noise (measured on a DVXplorer). "
    "A pixel's own is in inverse proportion to its ON threshold (v2e), against the mean of all: "
    "with lower thresholds for all there are more events of signals, but no more of noise.");
  v("shot_noise_off_hz", shot_noise_off_hz, 0, 1000,
    "The same for OFF events, by the OFF threshold.");
  v("shot_noise_bright_share", shot_noise_bright_share, 0, 1,
    "Share of these rates that is left at 1000 lux on white; they fall linearly (v2e: 0.25), so "
    "that they hardly differ below 100 lux.");
  v("hot_pixel_fraction", hot_pixel_fraction, 0, 1,
    "Share of the pixels that are hot (measured on a DVXplorer).");
  v("hot_pixel_hz", hot_pixel_hz, 0, 100000,
    "Mean rate of the noise of a hot pixel (DVXplorer: hot pixels carry 20 % of all noise), "
    "refractory periods not counted; ON and OFF in the proportion of the shot noise.");
  v("hot_pixel_sigma", hot_pixel_sigma, 0, 2,
    "Standard deviation of the logarithm of these rates, which are log-normal: with 1.05 a tenth "
    "of the hot pixels has less than 23 Hz and a tenth more than 340, as measured on the "
    "DVXplorer. 0: all have the mean.");
  v("dead_pixel_fraction", dead_pixel_fraction, 0, 1,
    "Share of the pixels that never make an event (assumed).");
  v("device", device, {"campaign", "throw"},
    "Which pixels are hot or dead, and the thresholds of each, are those of one specimen. "
    "campaign: all throws of a seed see through one and the same pair of cameras, and rates and "
    "their intervals hold for that pair. throw: through a new pair each, and they hold for "
    "cameras of this kind. A film (dodgesim emulate) is seen by one camera.");
  v("latency_us", latency_us, 0, 100000,
    "From the change of the light to the request of the pixel (IEBCS: 100). In the time stamp, as "
    "the readout stamps.");
  v("jitter_us", jitter_us, 0, 100000,
    "Standard deviation of the latency from event to event (IEBCS: 10), whatever the light and the "
    "contrast. No event is early: what "
    "would fall below 0 is 0. Drawn for each event by itself, so that events of a pixel with a "
    "refractory period shorter than the jitter may change places.");
  v("readout_max_hz", readout_max_hz, 0, 1e9,
    "Events that the readout can serve in a second (assumed). Requests wait in line; a pixel that "
    "waits makes no other event, which is counted as lost. 0: no limit.");
  v("stamp_resolution_us", stamp_resolution_us, 1, 100000,
    "Time stamps are multiples of this since the first frame, rounded up from the nearest "
    "microsecond (from the next one for what happens within 0.5 us after a frame). 1: as event "
    "cameras give them.");
}

struct SamplingSpec {
  double max_displacement_px = 0.5;
  double min_rate_hz = 200;
  std::int64_t min_interval_us = 250;

  template <class Visitor>
  void visit(Visitor& v) {
    v("max_displacement_px", max_displacement_px, 0.01, 100,
      "Nothing in the image moves farther than this between two samples (0.5 px loses 0.6 % of the "
      "events of a texture that is a sine of 8 px wavelength in log luminance, 1 px 2.3 %; of one "
      "of luminance with a contrast of 0.8 1.1 % and 4.4 %).");
    v("min_rate_hz", min_rate_hz, 1, 4000,
      "Rate of the samples of the whole image when nothing moves; its inverse bounds how late an "
      "event is known.");
    v("min_interval_us", min_interval_us, 1, 1000000,
      "Shortest time between two samples of the same object or of the room that their motion asks "
      "for, which bounds the cost of what fills the view. With 250 us and 0.5 px "
      "(max_displacement_px) what moves faster than "
      "2000 px/s is under-sampled: an object that passes within about a metre, or the room while "
      "the vehicle turns at more than 5 to 10 rad/s.");
  }
};

}  // namespace dodgesim
