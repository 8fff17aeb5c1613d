#include "sim/events/poisson_events.h"

#include <utility>

#include "sim/events/logarithm.h"

namespace dodgesim {

PoissonEvents::PoissonEvents(const RandomStream& stream, std::uint32_t pixel_count, double rate_hz,
                             double on_share)
    : stream_(stream),
      pixel_count_(pixel_count),
      mean_wait_us_(rate_hz > 0 && pixel_count > 0 ? 1e6 / (rate_hz * pixel_count) : 0),
      on_share_(on_share) {
  reset(0);
}

PoissonEvents::PoissonEvents(const RandomStream& stream, std::vector<std::uint32_t> pixels,
                             double rate_hz, double on_share)
    : PoissonEvents(stream, static_cast<std::uint32_t>(pixels.size()), rate_hz, on_share) {
  pixels_ = std::move(pixels);
  reset(0);
}

void PoissonEvents::reset(TimeUs t_us) {
  origin_us_ = t_us;
  time_us_ = 0;
  number_ = 0;
  if (mean_wait_us_ > 0) draw();
}

void PoissonEvents::take_until(TimeUs t_us, std::vector<PoissonEvent>& out) {
  if (mean_wait_us_ == 0) return;
  while (next_.t_us <= t_us) {
    out.push_back(next_);
    draw();
  }
}

void PoissonEvents::draw() {
  const auto random = stream_.block(number_++);
  time_us_ -= mean_wait_us_ * natural_log(unit_interval(random[0]));
  const std::uint64_t index = (static_cast<std::uint64_t>(random[1]) * pixel_count_) >> 32;
  next_.pixel = pixels_.empty() ? static_cast<std::uint32_t>(index) : pixels_[index];
  next_.on = unit_interval(random[2]) < on_share_;
  next_.chance = unit_interval(random[3]);
  // The clock's first microsecond at or after the event.
  const auto whole = static_cast<TimeUs>(time_us_);
  next_.t_us = origin_us_ + whole + (static_cast<double>(whole) < time_us_ ? 1 : 0);
}

}  // namespace dodgesim
