#include "sim/bench/timed_emulation.h"

#include "sim/base/wall_clock.h"

namespace dodgesim {

TimedEmulation::TimedEmulation(EventCamera& camera, double log_epsilon)
    : camera_(camera),
      log_epsilon_(static_cast<float>(log_epsilon)),
      shifted_(camera.height(), camera.width(), CV_32F),
      log_(camera.height(), camera.width(), CV_32F, cv::Scalar(0)) {}

void TimedEmulation::update_between(TimeUs t_us, const std::vector<float>& luminance,
                                    std::vector<Event>& out) {
  const std::size_t before = out.size();
  const auto start = WallClock::now();
  camera_.update(t_us, luminance.data(), out);
  emulation_s_ += seconds_since(start);
  events_ += static_cast<std::int64_t>(out.size() - before);
}

void TimedEmulation::update(TimeUs t_us, const std::vector<float>& luminance,
                            std::vector<Event>& out) {
  update_between(t_us, luminance, out);
  ++frames_;

  float* const shifted = shifted_.ptr<float>();
  for (std::size_t i = 0; i < luminance.size(); ++i) shifted[i] = luminance[i] + log_epsilon_;
  const auto start = WallClock::now();
  cv::log(shifted_, log_);
  log_s_ += seconds_since(start);
}

}  // namespace dodgesim
