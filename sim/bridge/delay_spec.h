// The latency chain from an event's time stamp to the rotor, all in simulated time (design
// invariant 4). What comes before the stamp, the pixel's latency, belongs to the event camera; the
// ESC delay and the rotors' lag belong to the motors.
#pragma once

#include <algorithm>
#include <numeric>

#include "sim/base/time.h"

namespace dodgesim {

struct DelaySpec {
  int transport_us = 1000;       // USB, from the end of a packet to the computer
  int lower_camera_us = 0;       // on top of that, for the lower camera's packets
  int imu_us = 500;              // IMU sample to the computer
  int state_estimate_us = 2000;  // age of the state estimate when the computer receives it
  int range_us = 2000;
  int cycle_us = 4000;             // from the start of one cycle of the pilot to the next
  int compute_us = 3500;           // one cycle of the pilot
  int perception_us = 0;           // on top of that, pipelined: cycles stay as frequent
  int packet_us = 1000;            // USB packets of events end at multiples of this
  int command_us = 3000;           // serial link to the flight controller
  int flight_controller_us = 250;  // from a received command to the rotor commands

  // From the end of a packet of camera 0 (the upper one) or 1 to the computer.
  int transport_us_of(int camera) const {
    return transport_us + (camera > 0 ? lower_camera_us : 0);
  }

  // From the start of a cycle to its command.
  int pilot_us() const { return compute_us + perception_us; }

  // From a command to the rotor commands that it causes.
  int link_us() const { return command_us + flight_controller_us; }

  // From one cycle to the next, in whole ticks. No cycle starts before the last one has ended.
  TimeUs period_us() const {
    const TimeUs least_us = std::max(cycle_us, compute_us);
    return (least_us + kTickUs - 1) / kTickUs * kTickUs;
  }

  // End of the newest event packet that a cycle has received from the upper camera, a multiple of
  // packet_us; not above 0 if there is none.
  TimeUs newest_packet_end_us(TimeUs cycle_start_us) const {
    const TimeUs sent_us = cycle_start_us - transport_us;
    const TimeUs into_packet_us = (sent_us % packet_us + packet_us) % packet_us;
    return sent_us - into_packet_us;
  }

  // Age of a camera's newest packet at a cycle that gets it as early as any does: packets end at
  // whole multiples of packet_us, cycles start at those of the period.
  TimeUs least_event_age_us(int camera) const {
    const TimeUs step_us = std::gcd(packet_us, period_us());
    return (transport_us_of(camera) + step_us - 1) / step_us * step_us;
  }

  // By how much the lower camera's newest packet is older than the upper one's at a cycle at which
  // they are nearest: whole packets.
  TimeUs least_lag_us() const {
    const TimeUs step_us = std::gcd(packet_us, period_us());
    // The longest that the upper camera's newest packet may have waited.
    const TimeUs waited_us = packet_us - step_us + least_event_age_us(0) - transport_us;
    const TimeUs packets = lower_camera_us / packet_us;
    const TimeUs rest_us = lower_camera_us % packet_us;
    return (packets + (rest_us > waited_us ? 1 : 0)) * packet_us;
  }

  template <class Visitor>
  void visit(Visitor& v) {
    v("transport_us", transport_us, 0, 100000,
      "USB: end of a packet to the computer (1 to 2 ms worst case for USB cameras). Of events that "
      "come later than dodger.window.event_timeout_us our pilots see the fewer the later, as their "
      "window does not wait: raise that, too, or use perception_us.");
    v("lower_camera_us", lower_camera_us, 0, 100000,
      "The packets of the lower camera come later than the upper one's by this. Pilots that know "
      "the truth are as fast as the upper one.");
    v("imu_us", imu_us, 0, 100000, "IMU sample to the computer.");
    v("state_estimate_us", state_estimate_us, 0, 100000,
      "Age of a state estimate when the computer receives it.");
    v("range_us", range_us, 0, 100000, "Age of a range reading when the computer receives it.");
    v("packet_us", packet_us, 125, 100000,
      "USB packets of events end at multiples of this (1 ms: a USB frame).");
    v("cycle_us", cycle_us, 250, 1000000,
      "The pilot starts a cycle this often, or as soon as it has finished the last one (250 Hz, "
      "the rate of the state estimate).");
    v("compute_us", compute_us, 0, 1000000,
      "One cycle of the pilot, from its newest data to its command (3.5 ms in the paper's Table "
      "3).");
    v("perception_us", perception_us, 0, 1000000,
      "Added to compute_us, but the pilot's cycles stay as frequent: a slow perception that is "
      "pipelined. Not part of the paper's chain, but for experiments with latency.");
    v("command_us", command_us, 0, 100000,
      "Serial link from the computer to the flight controller (3.0 ms measured by the authors). "
      "A command to evade takes it at once, others with the next state estimate.");
    v("flight_controller_us", flight_controller_us, 0, 100000,
      "From a received command to the rotor commands it causes (one 4 kHz cycle).");
  }
};

}  // namespace dodgesim
