#include "sim/events/poisson_events.h"

#include <algorithm>

#include "sim/events/logarithm.h"

namespace dodgesim {

namespace {

constexpr double kNeverUs = 1e18;  // 30,000 years, which a clock of 64 bits still holds

}  // namespace

PoissonEvents::PoissonEvents(const RandomStream& stream, const std::vector<PixelRate>& rates)
    : stream_(stream) {
  std::vector<double> rates_hz;
  rates_hz.reserve(2 * rates.size());
  pixels_.reserve(rates.size());
  double sum_hz = 0;
  for (const PixelRate& rate : rates) {
    pixels_.push_back(rate.pixel);
    rates_hz.insert(rates_hz.end(), {rate.off_hz, rate.on_hz});
    sum_hz += rate.off_hz + rate.on_hz;
  }
  if (sum_hz > 0) {
    choice_ = WeightedChoice(rates_hz);
    mean_wait_us_ = 1e6 / sum_hz;
  }
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
  time_us_ = std::min(time_us_, kNeverUs);
  const std::uint32_t choice = choice_.pick(random[1], random[2]);
  next_.pixel = pixels_[choice / 2];
  next_.on = choice % 2 == 1;
  next_.chance = unit_interval(random[3]);
  // The clock's first microsecond at or after the event.
  const auto whole = static_cast<TimeUs>(time_us_);
  next_.t_us = origin_us_ + whole + (static_cast<double>(whole) < time_us_ ? 1 : 0);
}

}  // namespace dodgesim
