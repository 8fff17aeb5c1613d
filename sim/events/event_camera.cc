#include "sim/events/event_camera.h"

#include <stdexcept>
#include <string>

#include "sim/base/random.h"
#include "sim/events/stream_name.h"

namespace dodgesim {

namespace {

std::size_t checked_pixels(int width, int height) {
  for (const int side : {width, height}) {
    if (side < 1 || side > EventCamera::kMaxSide) {
      throw std::invalid_argument("An event camera has 1 to " +
                                  std::to_string(EventCamera::kMaxSide) + " columns and rows.");
    }
  }
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

}  // namespace

EventCamera::EventCamera(const EventCameraSpec& spec, int width, int height, std::uint64_t seed,
                         std::uint64_t throw_index, std::string_view name, bool keep_causes)
    : EventCamera(spec, width, height, seed, throw_index, name, keep_causes,
                  draw_thresholds(spec, checked_pixels(width, height),
                                  RandomStream(seed, spec.device_index(throw_index),
                                               stream_name(name, "device")))) {}

EventCamera::EventCamera(const EventCameraSpec& spec, int width, int height, std::uint64_t seed,
                         std::uint64_t throw_index, std::string_view name, bool keep_causes,
                         const std::vector<Thresholds>& thresholds)
    : width_(width),
      height_(height),
      keep_causes_(keep_causes),
      pixels_(spec, width, height, thresholds,
              RandomStream(seed, throw_index, stream_name(name, "start")), keep_causes),
      noise_(spec, width, thresholds, seed, throw_index, name),
      readout_(spec, width, height, RandomStream(seed, throw_index, stream_name(name, "jitter"))) {}

void EventCamera::reset(TimeUs t_us, const Picture& picture) {
  t_us_ = last_sample_us_ = t_us;
  noise_.reset(t_us);
  pixels_.reset(t_us, picture, noise_);
  readout_.reset(t_us);
  words_.clear();
  causes_.clear();
}

void EventCamera::check_time(TimeUs t_us) const {
  if (t_us <= last_sample_us_) {
    throw std::invalid_argument("The samples of an event camera must follow each other in time.");
  }
  if (t_us - t_us_ > kMaxIntervalUs) {
    throw std::invalid_argument("The pictures of an event camera must be at most " +
                                std::to_string(kMaxIntervalUs) + " us apart.");
  }
}

void EventCamera::sample(TimeUs t_us, const Rect& region, const Picture& picture) {
  check_time(t_us);
  const auto noise = noise_.take(t_us, region, picture.luminance);
  pixels_.sample(t_us, region, picture, noise, t_us_, words_);
  last_sample_us_ = t_us;
}

void EventCamera::add_region(TimeUs t_us, const Rect& region, const Picture& picture) {
  check_time(t_us);
  if (region.empty()) return;
  if (region.x0 < 0 || region.y0 < 0 || region.x1 > width_ || region.y1 > height_) {
    throw std::invalid_argument("A region of an event camera's picture must lie in the picture.");
  }
  sample(t_us, region, picture);
}

void EventCamera::update(TimeUs t_us, const Picture& picture, std::vector<Event>& out) {
  sample(t_us, {0, 0, width_, height_}, picture);
  causes_.clear();
  readout_.push(words_, t_us_, t_us, out, keep_causes_ ? &causes_ : nullptr);
  words_.clear();
  t_us_ = t_us;
}

void EventCamera::rebase(const Picture& picture) {
  if (last_sample_us_ != t_us_) {
    throw std::invalid_argument("An event camera is rebased at the instant of a whole picture.");
  }
  pixels_.rebase(picture);
}

PixelState EventCamera::pixel(int x, int y) const {
  return pixels_.state(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x));
}

}  // namespace dodgesim
