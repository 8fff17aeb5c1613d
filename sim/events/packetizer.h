// The USB link: groups the events of a camera into packets of a fixed period.
//
// The packet that ends at T holds the events in (T - period, T]. It is complete, and may be taken,
// once the camera has been sampled at T or later; whoever carries it delivers it at T + transport
// delay or, when it was completed later than that, at once. So no event arrives before its stamp
// plus the transport delay. Periods without events make no packet.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim/base/time.h"
#include "sim/events/cause.h"
#include "sim/events/event.h"

namespace dodgesim {

struct Packet {
  TimeUs end_us = 0;
  std::span<const Event> events;       // valid until the next push() or reset()
  std::span<const Cause> causes = {};  // one an event, or none
};

class Packetizer {
 public:
  // Packets end at multiples of period_us. Throws std::invalid_argument unless period_us > 0.
  explicit Packetizer(TimeUs period_us);

  // Forgets all events.
  void reset();

  // Adds events in order of time; all events up to and including complete_us are now known.
  // `causes` has one an event, always or never.
  void push(std::span<const Event> events, TimeUs complete_us, std::span<const Cause> causes = {});

  // The oldest complete packet that has not been taken.
  std::optional<Packet> take();

 private:
  TimeUs end_of_packet(TimeUs t_us) const;

  TimeUs period_us_;
  TimeUs complete_us_ = 0;
  std::vector<Event> events_;
  std::vector<Cause> causes_;  // of events_, or empty
  std::size_t taken_ = 0;      // events already handed out, at the front
};

}  // namespace dodgesim
