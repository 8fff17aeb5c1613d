// A pilot on recorded data: handed to it cycle by cycle, as late as the computer of a vehicle would
// get it (sim/bridge/onboard_computer.h). What it commands moves nobody, and its goal is the place
// of the newest state.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dodge/pilot.h"
#include "sim/bridge/onboard_computer.h"
#include "sim/events/packetizer.h"
#include "sim/playback/event_queue.h"
#include "sim/sensors/readings.h"

namespace dodgesim {

struct RecordedSensors {
  std::vector<std::unique_ptr<EventReader>> cameras;  // in the order of the pilot's
  std::vector<std::string> files;                     // theirs, for messages; may be empty
  std::vector<ImuReading> imu;                        // in B; may be empty, as the others
  std::vector<StateReading> states;  // empty: in its place, turning as the IMU says, if it does
  std::vector<RangeReading> ranges;
};

class Playback {
 public:
  // Events that stand in their file up to EventQueue::kSortedUs too late are put in order; the
  // pilot gets others too late, and drops them. Strays (event_queue.h) are passed over.
  //
  // Cycles begin at multiples of delays.period_us() on the recording's clock, the first after the
  // first event. Throws ScenarioError if no camera has any event, or a log has no reading while
  // there are events, and next() does at the end if most of a camera's events are strays; all
  // functions throw as EventReader does.
  Playback(const DelaySpec& delays, std::unique_ptr<dodge::Pilot> pilot, RecordedSensors sensors);

  // Runs the next cycle; false when the pilot has had every event.
  bool next();

  // Of the last cycle.
  TimeUs now_us() const { return now_us_; }
  const dodge::VelocityCommand& command() const { return command_; }
  const dodge::Pilot& pilot() const { return computer_.pilot(); }
  dodge::Pilot& pilot() { return computer_.pilot(); }

  // Of the last cycle: the camera's events whose time it brought, in order.
  std::span<const Event> new_events(int camera) const;

  TimeUs first_event_us() const { return first_event_us_; }
  TimeUs last_event_us() const { return last_event_us_; }  // of those handed over so far
  std::int64_t events(int camera) const;                   // so far
  TimeUs first_event_us(int camera) const;                 // so far; requires events()
  TimeUs last_event_us(int camera) const;
  // So far, of those: that stood more than EventQueue::kSortedUs too late in their file.
  std::int64_t late(int camera) const;
  std::int64_t strays(int camera) const;  // so far
  double part_played(int camera) const;   // of the camera's file, 0 to 1

 private:
  // What comes from one camera.
  struct Eye {
    Eye(std::string name_in_messages, std::unique_ptr<EventReader> events, TimeUs packet_us)
        : name(std::move(name_in_messages)), queue(std::move(events)), packetizer(packet_us) {}

    std::string name;
    EventQueue queue;
    Packetizer packetizer;
    std::vector<Event> held;                                // in order of time, not yet due
    std::vector<Event> due;                                 // since the last cycle
    std::int64_t count = 0;                                 // of those that were due
    TimeUs first_us = 0, last_us = 0;                       // of those
    std::int64_t late = 0;                                  // of those read
    TimeUs newest_us = std::numeric_limits<TimeUs>::min();  // of those read
  };

  void hold(Eye& eye, TimeUs until_us);
  void send_events(int camera);
  void send_readings();
  void expect_same_clock() const;
  void expect_few_strays() const;
  std::vector<StateReading> states_from_rates() const;

  DelaySpec delays_;
  OnboardComputer computer_;
  std::vector<Eye> eyes_;
  std::vector<ImuReading> imu_;
  std::vector<StateReading> states_;
  std::vector<RangeReading> ranges_;
  std::size_t imu_sent_ = 0, states_sent_ = 0, ranges_sent_ = 0;
  TimeUs now_us_ = 0, first_event_us_ = 0, last_event_us_ = 0;
  dodge::VelocityCommand command_;
};

}  // namespace dodgesim
