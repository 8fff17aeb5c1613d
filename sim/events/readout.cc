#include "sim/events/readout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dodgesim {

namespace {

// Jitters are drawn from this many equally likely values, 16 bits of randomness each.
constexpr std::size_t kQuantiles = 4096;
constexpr int kDropBits = 4;
constexpr std::uint64_t kDrawsPerBlock = 8;

constexpr double kNever = -std::numeric_limits<double>::infinity();

// The longest that one service may take; keeps times finite.
constexpr double kLongestServiceUs = 1e9;

// The first multiple of the resolution that is not before t_us.
TimeUs rounded_up(TimeUs t_us, TimeUs resolution_us) {
  const TimeUs after_us = t_us % resolution_us;
  return after_us > 0 ? t_us + resolution_us - after_us : t_us - after_us;
}

}  // namespace

Readout::Readout(const EventCameraSpec& spec, int width, int height, const RandomStream& stream)
    : immediate_(spec.latency_us == 0 && spec.jitter_us == 0 && spec.readout_max_hz == 0 &&
                 spec.stamp_resolution_us == 1),
      latency_us_(static_cast<double>(spec.latency_us)),
      jitter_us_(spec.jitter_us),
      service_us_(spec.readout_max_hz > 0 ? std::min(1e6 / spec.readout_max_hz, kLongestServiceUs)
                                          : 0),
      resolution_us_(spec.stamp_resolution_us),
      width_(static_cast<std::size_t>(width)),
      stream_(stream) {
  if (jitter_us_ > 0) {
    for (std::size_t i = 0; i < kQuantiles; ++i) {
      normals_.push_back(normal_quantile((static_cast<double>(i) + 0.5) / kQuantiles));
    }
  }
  if (service_us_ > 0) waits_until_.resize(width_ * static_cast<std::size_t>(height));
}

void Readout::reset(TimeUs t_us) {
  reset_us_ = t_us;
  drawn_ = 0;
  free_us_ = kNever;
  std::fill(waits_until_.begin(), waits_until_.end(), kNever);
  lost_ = 0;
  to_arrive_.clear();
  to_leave_.clear();
}

// How late the next event is at the arbiter.
TimeUs Readout::late_us() {
  double late_us = latency_us_;
  if (jitter_us_ > 0) {
    const std::uint64_t half = drawn_ % kDrawsPerBlock;
    if (half == 0) random_ = stream_.block(drawn_ / kDrawsPerBlock);
    ++drawn_;
    const std::uint32_t bits = random_[half / 2] >> (half % 2 == 0 ? 0 : 16) & 0xffffu;
    late_us = std::max(0.0, late_us + jitter_us_ * normals_[bits >> kDropBits]);
  }
  return static_cast<TimeUs>(late_us + 0.5);
}

void Readout::push(EventWords& events, TimeUs origin_us, TimeUs t_us, std::vector<Event>& out,
                   std::vector<Cause>* causes) {
  EventWords* ready = &events;
  if (!immediate_) {
    arrive(events, origin_us, t_us);
    ready = &leaving_;
  }
  for (std::size_t i = 0; i < ready->size(); ++i) {
    out.push_back(ready->event(i, origin_us));
    if (causes != nullptr) causes->push_back(ready->cause(i));
  }
}

// Moves events to the arbiter and from there to leaving_, as far as they come until t_us.
void Readout::arrive(EventWords& events, TimeUs origin_us, TimeUs t_us) {
  arriving_.clear();
  for (const Later& later : to_arrive_) arriving_.push(later.t_us - origin_us, later.rest);
  for (std::size_t i = 0; i < events.size(); ++i) {
    arriving_.push(events.since_us(i) + late_us(), events.rest(i));
  }
  arriving_.sort();

  leaving_.clear();
  for (const Later& later : to_leave_) {
    if (later.t_us <= t_us) leaving_.push(later.t_us - origin_us, later.rest);
  }
  std::erase_if(to_leave_, [t_us](const Later& later) { return later.t_us <= t_us; });
  to_arrive_.clear();
  for (std::size_t i = 0; i < arriving_.size(); ++i) {
    const TimeUs arrival_us = origin_us + arriving_.since_us(i);
    if (arrival_us > t_us) {
      to_arrive_.push_back({arrival_us, arriving_.rest(i)});
      continue;
    }
    const Event event = arriving_.event(i, origin_us);
    const auto since_us = static_cast<double>(arrival_us - reset_us_);
    if (!serve(since_us, event.y * width_ + event.x)) continue;
    const auto served_us = reset_us_ + static_cast<TimeUs>(std::ceil(served_us_));
    const TimeUs stamp_us = rounded_up(served_us, resolution_us_);
    if (stamp_us <= t_us) {
      leaving_.push(stamp_us - origin_us, arriving_.rest(i));
    } else {
      to_leave_.push_back({stamp_us, arriving_.rest(i)});
    }
  }
  leaving_.sort_ties();
}

// The arbiter takes a request at served_us_. False: it is lost, the pixel has one waiting already.
bool Readout::serve(double request_us, std::size_t pixel) {
  served_us_ = request_us;
  if (service_us_ == 0) return true;
  if (request_us < free_us_) {
    if (waits_until_[pixel] > request_us) {
      ++lost_;
      return false;
    }
    served_us_ = waits_until_[pixel] = free_us_;
  }
  free_us_ = served_us_ + service_us_;
  return true;
}

}  // namespace dodgesim
