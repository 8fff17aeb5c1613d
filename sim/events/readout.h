// The readout of an event camera: the way of an event from its pixel to its time stamp.
//
// Each event is late by the pixel's latency with its jitter. Then it asks the arbiter, which serves
// requests in the order in which they come (row by row in the same microsecond), one in
// 1/readout_max_hz. While a pixel waits, it makes no other request: such events are lost, and
// counted; their change of light is forgotten. So no more events wait than there are pixels. The
// time stamp is the microsecond in which the service begins, rounded up to a multiple of the
// clock's resolution. Under random requests of rate r below the limit m the mean wait is that of a
// queue with one server and constant service time, r/(2 m (m - r)); above it the line grows until
// pixels wait that fire again. An event leaves once the clock has reached its stamp.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/random.h"
#include "sim/base/time.h"
#include "sim/events/event_words.h"
#include "sim/events/spec.h"

namespace dodgesim {

class Readout {
 public:
  // The jitter is drawn from `stream`.
  Readout(const EventCameraSpec& spec, int width, int height, const RandomStream& stream);

  void reset(TimeUs t_us);

  // Takes the events of the pixels up to t_us, in any order, with times since origin_us. Appends
  // those that have left the readout by t_us, in order (t, y, x, polarity). `causes` may be null.
  void push(EventWords& events, TimeUs origin_us, TimeUs t_us, std::vector<Event>& out,
            std::vector<Cause>* causes);

  // Events that a waiting pixel did not make, since the reset.
  std::int64_t lost() const { return lost_; }
  // Events that have not yet left it.
  std::int64_t under_way() const {
    return static_cast<std::int64_t>(to_arrive_.size() + to_leave_.size());
  }

 private:
  // An event whose time has not yet come.
  struct Later {
    TimeUs t_us;
    std::uint64_t rest;  // all but its time, see EventWords
  };

  TimeUs late_us(TimeUs since_reset_us, std::uint64_t rest) const;
  static void move_due(std::vector<Later>& waiting, TimeUs origin_us, TimeUs t_us,
                       EventWords& words);
  void arrive(EventWords& events, TimeUs origin_us, TimeUs t_us);
  std::size_t pixel(const Event& event) const { return event.y * width_ + event.x; }
  bool serve(double request_us, std::size_t pixel);

  bool immediate_;  // nothing to do
  double service_us_;
  TimeUs resolution_us_;
  std::size_t width_;
  TimeUs reset_us_ = 0;

  std::uint64_t jitter_key_;
  std::vector<TimeUs> lateness_us_;  // equally likely

  double free_us_ = 0;               // when the arbiter has served all, since the reset
  double served_us_ = 0;             // when it takes the event that it is given last
  std::vector<double> waits_until_;  // when each pixel's last request is served
  std::int64_t lost_ = 0;

  std::vector<Later> to_arrive_, to_leave_;
  EventWords arriving_, leaving_;  // scratch
};

}  // namespace dodgesim
