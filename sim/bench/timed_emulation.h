// How long an event camera takes for a video, beside the least that any such camera must do.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/base/time.h"
#include "sim/events/event_camera.h"

namespace dodgesim {

// Wall-clock time per picture of EventCamera::update() and, right after it, of cv::log of the same
// picture (eps + I as float), each picture by itself and nothing else but add_preparation()'s. Both
// find the picture in the cache, as after rendering; eps + I is made before the clock starts. One
// thread.
class TimedEmulation {
 public:
  // The camera must outlive this object and have had its reset().
  TimedEmulation(EventCamera& camera, double log_epsilon);

  // EventCamera::update(), timed.
  void update(TimeUs t_us, const std::vector<float>& luminance, std::vector<Event>& out);

  // The same for what is seen between two pictures, which is no picture of its own: its time counts
  // to that of the next.
  void update_between(TimeUs t_us, const std::vector<float>& luminance, std::vector<Event>& out);

  // Adds the time that it took to make what is seen between two pictures: it is the next one's.
  void add_preparation(double time_s) { emulation_s_ += time_s; }

  std::int64_t frames() const { return frames_; }
  std::int64_t events() const { return events_; }
  double emulation_s() const { return emulation_s_; }
  double log_s() const { return log_s_; }

 private:
  EventCamera& camera_;
  float log_epsilon_;
  cv::Mat shifted_, log_;
  std::int64_t frames_ = 0;
  std::int64_t events_ = 0;
  double emulation_s_ = 0;
  double log_s_ = 0;
};

}  // namespace dodgesim
