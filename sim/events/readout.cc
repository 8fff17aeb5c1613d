#include "sim/events/readout.h"

#include <algorithm>
#include <limits>

#include "sim/base/branchless.h"
#include "sim/base/normal_distribution.h"

namespace dodgesim {

namespace {

// How late an event is at the arbiter is drawn from this many equally likely values.
constexpr int kLatenessBits = 12;
constexpr std::size_t kLatenesses = std::size_t{1} << kLatenessBits;

// How far ahead what is known of a pixel is fetched from memory.
constexpr std::size_t kAhead = 8;

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
      service_us_(spec.readout_max_hz > 0 ? std::min(1e6 / spec.readout_max_hz, kLongestServiceUs)
                                          : 0),
      resolution_us_(spec.stamp_resolution_us),
      width_(static_cast<std::size_t>(width)) {
  const auto random = stream.block(0);
  jitter_key_ = std::uint64_t{random[1]} << 32 | random[0];
  for (std::size_t i = 0; i < kLatenesses; ++i) {
    const double normal = normal_quantile((static_cast<double>(i) + 0.5) / kLatenesses);
    const double late_us = static_cast<double>(spec.latency_us) + spec.jitter_us * normal;
    const double half_more_us = std::max(0.0, late_us) + 0.5;
    lateness_us_.push_back(static_cast<TimeUs>(half_more_us));
  }
  if (service_us_ > 0) waits_until_.resize(width_ * static_cast<std::size_t>(height));
}

void Readout::reset(TimeUs t_us) {
  reset_us_ = t_us;
  free_us_ = kNever;
  std::fill(waits_until_.begin(), waits_until_.end(), kNever);
  lost_ = 0;
  to_arrive_.clear();
  to_leave_.clear();
}

// How late the event is at the arbiter: a function of its pixel and its instant alone, whatever the
// order in which events come.
TimeUs Readout::late_us(TimeUs since_reset_us, std::uint64_t rest) const {
  const std::uint64_t counter = static_cast<std::uint64_t>(since_reset_us)
                                    << EventWords::kRestBits |
                                EventWords::without_cause(rest);
  return lateness_us_[mixed_bits(jitter_key_, counter) >> (64 - kLatenessBits)];
}

void Readout::push(EventWords& events, TimeUs origin_us, TimeUs t_us, std::vector<Event>& out,
                   std::vector<Cause>* causes) {
  EventWords* ready = &events;
  if (immediate_) {
    events.sort();
  } else {
    arrive(events, origin_us, t_us);
    ready = &leaving_;
  }
  for (std::size_t i = 0; i < ready->size(); ++i) {
    out.push_back(ready->event(i, origin_us));
    if (causes != nullptr) causes->push_back(ready->cause(i));
  }
}

// Moves those that are due by t_us to `words`, whose times count from origin_us.
void Readout::move_due(std::vector<Later>& waiting, TimeUs origin_us, TimeUs t_us,
                       EventWords& words) {
  for (const Later& later : waiting) {
    if (later.t_us <= t_us) words.push(later.t_us - origin_us, later.rest);
  }
  std::erase_if(waiting, [t_us](const Later& later) { return later.t_us <= t_us; });
}

// Moves events to the arbiter and from there to leaving_, as far as they come until t_us.
void Readout::arrive(EventWords& events, TimeUs origin_us, TimeUs t_us) {
  arriving_.clear();
  leaving_.clear();
  move_due(to_arrive_, origin_us, t_us, arriving_);
  move_due(to_leave_, origin_us, t_us, leaving_);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const TimeUs made_us = origin_us + events.since_us(i);
    const std::uint64_t rest = events.rest(i);
    const TimeUs arrival_us = made_us + late_us(made_us - reset_us_, rest);
    if (arrival_us <= t_us) {
      arriving_.push(arrival_us - origin_us, rest);
    } else {
      to_arrive_.push_back({arrival_us, rest});
    }
  }
  arriving_.sort();

  for (std::size_t i = 0; i < arriving_.size(); ++i) {
    if (service_us_ > 0 && i + kAhead < arriving_.size()) {
      __builtin_prefetch(&waits_until_[pixel(arriving_.event(i + kAhead, origin_us))]);
    }
    const Event event = arriving_.event(i, origin_us);
    if (!serve(static_cast<double>(event.t_us - reset_us_), pixel(event))) continue;
    const auto served_us = reset_us_ + static_cast<TimeUs>(served_us_);
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
  if (waits_until_[pixel] > request_us) {
    ++lost_;
    return false;
  }
  // No branch: whether one has to wait cannot be predicted.
  served_us_ = waits_until_[pixel] = larger(request_us, free_us_);
  free_us_ = served_us_ + service_us_;
  return true;
}

}  // namespace dodgesim
