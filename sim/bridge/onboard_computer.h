// The computer that carries the pilot: sensor data reach it late, it works in cycles, and each
// cycle takes time. Where the simulator's readings become the flight core's.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dodge/pilot.h"
#include "sim/bridge/delay_line.h"
#include "sim/bridge/delay_spec.h"
#include "sim/events/event.h"
#include "sim/sensors/readings.h"

namespace dodgesim {

class OnboardComputer {
 public:
  // A cycle starts every delays.period_us(), the first after one period.
  OnboardComputer(const DelaySpec& delays, std::unique_ptr<dodge::Pilot> pilot);

  void set_goal(const dodge::Goal& goal) { pilot_->set_goal(goal); }

  // Each at the instant at which the sensor has it. An event packet may be empty.
  void send_events(int camera, TimeUs packet_end_us, std::span<const Event> packet);
  void send_imu(const ImuReading& reading);
  void send_state(const StateReading& reading);
  void send_range(const RangeReading& reading);

  // Runs the cycle that starts at now_us, if one does. True if one did.
  bool run_cycle(TimeUs now_us);

  // The newest command whose computation has ended by now_us, once.
  std::optional<dodge::VelocityCommand> take_command(TimeUs now_us);

  TimeUs next_cycle_us() const { return next_cycle_us_; }

  const dodge::Pilot& pilot() const { return *pilot_; }
  dodge::Pilot& pilot() { return *pilot_; }

 private:
  using Packet = std::vector<dodge::Event>;

  std::unique_ptr<dodge::Pilot> pilot_;
  DelaySpec delays_;
  TimeUs next_cycle_us_;
  std::vector<DelayLine<Packet>> packets_;  // by camera
  DelayLine<dodge::ImuSample> imu_;
  DelayLine<dodge::StateEstimate> states_;
  DelayLine<dodge::RangeReading> ranges_;
  DelayLine<dodge::VelocityCommand> commands_;
};

}  // namespace dodgesim
