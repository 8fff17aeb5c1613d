// What any pilot offers to whatever carries it: the simulator's bridge, a recording player, a
// vehicle. The paper's pilot is dodge::Dodger; a user's own dodger derives from this class too.
#pragma once

#include <span>

#include "dodge/types.h"

namespace dodge {

// Every flight has a pilot of its own, which is called from one thread only. Campaigns can be
// resumed, merged and replayed if a pilot is a function of its inputs: no clocks, no
// std::random_device, no races between threads, nothing left in statics by an earlier flight. A
// flight in which a pilot throws an exception is recorded as failed, with the exception's text;
// std::bad_alloc loses the whole throw.
class Pilot {
 public:
  virtual ~Pilot() = default;

  // Data arrive late, and each kind (of events, each camera's) in the order of its time stamps, but
  // for events of recordings whose files are out of order (`dodgesim detect` says so); there is no
  // order across kinds. The events are valid during the call only.
  virtual void add_events(int camera, std::span<const Event> events) = 0;
  virtual void add_imu(const ImuSample& sample) = 0;
  virtual void add_state(const StateEstimate& state) = 0;
  virtual void add_range(const RangeReading& /*reading*/) {}

  // Before the first update(), and again whenever the goal is another one, as at a waypoint.
  virtual void set_goal(const Goal& goal) = 0;

  // One cycle on all data received so far; now_us is the vehicle's clock. May be called before the
  // first state estimate or event; without an intention of its own, a pilot returns velocity zero.
  virtual VelocityCommand update(TimeUs now_us) = 0;

  // Of the last update, for logs and pictures. The spans are valid until the next update(). They
  // may be asked for several times or never.
  virtual std::span<const Detection> detections() const = 0;
  virtual std::span<const Obstacle> obstacles() const = 0;
};

}  // namespace dodge
