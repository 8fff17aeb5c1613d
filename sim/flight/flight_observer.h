// Who looks on while a flight is flown.
#pragma once

#include "dodge/pilot.h"
#include "sim/base/time.h"
#include "sim/events/packetizer.h"
#include "sim/sensors/readings.h"
#include "sim/world/world.h"

namespace dodgesim {

// Looks on, for pictures and logs. Nothing that it does changes the flight.
class FlightObserver {
 public:
  virtual ~FlightObserver() = default;
  // Whether the packets of on_events() must say why each event happened; asked once.
  virtual bool wants_causes() const { return false; }
  virtual void on_start(dodge::Pilot& /*pilot*/) {}
  virtual void on_tick(const World& /*world*/) {}
  virtual void on_imu(const ImuReading& /*reading*/) {}
  virtual void on_state(const StateReading& /*reading*/) {}
  virtual void on_range(const RangeReading& /*reading*/) {}
  virtual void on_events(int /*camera*/, const Packet& /*packet*/) {}
  // The cycle that on_cycle() tells of next is the first to detect a true object.
  virtual void on_first_detection() {}
  virtual void on_cycle(TimeUs /*now_us*/, const dodge::Pilot& /*pilot*/) {}
  // A command of the pilot arrives at the controller.
  virtual void on_velocity(TimeUs /*now_us*/, const dodge::VelocityCommand& /*command*/) {}
  // A command of the controller arrives at the flight controller.
  virtual void on_command(TimeUs /*now_us*/, bool /*evading*/) {}
};

}  // namespace dodgesim
