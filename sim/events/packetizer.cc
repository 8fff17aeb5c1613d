#include "sim/events/packetizer.h"

#include <stdexcept>

namespace dodgesim {

Packetizer::Packetizer(TimeUs period_us) : period_us_(period_us) {
  if (period_us < 1) throw std::invalid_argument("The period of event packets must be positive.");
}

void Packetizer::reset() {
  events_.clear();
  causes_.clear();
  taken_ = 0;
  complete_us_ = 0;
}

void Packetizer::push(std::span<const Event> events, TimeUs complete_us,
                      std::span<const Cause> causes) {
  const auto taken = static_cast<std::ptrdiff_t>(taken_);
  events_.erase(events_.begin(), events_.begin() + taken);
  if (!causes_.empty()) causes_.erase(causes_.begin(), causes_.begin() + taken);
  taken_ = 0;
  events_.insert(events_.end(), events.begin(), events.end());
  causes_.insert(causes_.end(), causes.begin(), causes.end());
  complete_us_ = complete_us;
}

std::optional<Packet> Packetizer::take() {
  if (taken_ == events_.size()) return std::nullopt;
  const TimeUs end_us = end_of_packet(events_[taken_].t_us);
  if (end_us > complete_us_) return std::nullopt;
  std::size_t last = taken_;
  while (last < events_.size() && events_[last].t_us <= end_us) ++last;
  Packet packet = {end_us, std::span(events_).subspan(taken_, last - taken_), {}};
  if (!causes_.empty()) packet.causes = std::span(causes_).subspan(taken_, last - taken_);
  taken_ = last;
  return packet;
}

// Events are stamped after time 0, when the camera is reset.
TimeUs Packetizer::end_of_packet(TimeUs t_us) const {
  return (t_us + period_us_ - 1) / period_us_ * period_us_;
}

}  // namespace dodgesim
