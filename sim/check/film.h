// Films that the self-tests show to an event camera, and what it makes of them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sim/events/event_camera.h"

namespace dodgesim {

// Fills in the picture of the instant t_us: row-major from the top left, linear luminance.
using Scene = std::function<void(TimeUs t_us, std::vector<float>& luminance)>;

// A picture without detail that has luminance(t_us) everywhere.
Scene even_scene(std::function<double(TimeUs t_us)> luminance);

// A random texture that drifts to the right at speed_pxps: eight plane waves of 8 px and more,
// 0.5 rms in log luminance about a luminance of 0.4.
class DriftingTexture {
 public:
  DriftingTexture(int width, int height, double speed_pxps, std::uint64_t seed);
  void operator()(TimeUs t_us, std::vector<float>& luminance) const;

 private:
  struct Wave {
    double kx, ky, phase;
  };
  int width_, height_;
  double speed_pxps_;
  std::vector<Wave> waves_;
};

// Instants step_us apart from 0 to end_us, both included.
std::vector<TimeUs> regular_times(TimeUs step_us, TimeUs end_us);

struct FilmedEvents {
  std::vector<Event> events;
  std::vector<Cause> causes;  // one an event
};

// Shows the scene at the given instants, the first of which sets the references. The camera must
// have been made with keep_causes.
FilmedEvents record(EventCamera& camera, const Scene& scene, std::span<const TimeUs> times);

// The same from where the last film has ended.
FilmedEvents record_on(EventCamera& camera, const Scene& scene, std::span<const TimeUs> times);

// The camera's pixels alone: without leak and noise, and without the readout's jitter, limit and
// clock. What is left is a function of the light.
EventCameraSpec without_noise(EventCameraSpec spec);

// The least cut-off of the camera's low-passes, in the dark [Hz]; infinite without one.
double slowest_hz(const EventCameraSpec& spec);

}  // namespace dodgesim
