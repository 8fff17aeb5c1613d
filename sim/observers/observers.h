// Several observers of one flight.
#pragma once

#include <algorithm>
#include <vector>

#include "sim/flight/flight_observer.h"

namespace dodgesim {

// Hands everything on to several observers.
class Observers : public FlightObserver {
 public:
  void add(FlightObserver* observer) { observers_.push_back(observer); }
  bool wants_causes() const override {
    return std::ranges::any_of(observers_, &FlightObserver::wants_causes);
  }
  void on_start(dodge::Pilot& pilot) override {
    for (FlightObserver* o : observers_) o->on_start(pilot);
  }
  void on_tick(const World& world) override {
    for (FlightObserver* o : observers_) o->on_tick(world);
  }
  void on_imu(const ImuReading& reading) override {
    for (FlightObserver* o : observers_) o->on_imu(reading);
  }
  void on_state(const StateReading& reading) override {
    for (FlightObserver* o : observers_) o->on_state(reading);
  }
  void on_range(const RangeReading& reading) override {
    for (FlightObserver* o : observers_) o->on_range(reading);
  }
  void on_events(int camera, const Packet& packet) override {
    for (FlightObserver* o : observers_) o->on_events(camera, packet);
  }
  void on_first_detection() override {
    for (FlightObserver* o : observers_) o->on_first_detection();
  }
  void on_cycle(TimeUs now_us, const dodge::Pilot& pilot) override {
    for (FlightObserver* o : observers_) o->on_cycle(now_us, pilot);
  }
  void on_velocity(TimeUs now_us, const dodge::VelocityCommand& command) override {
    for (FlightObserver* o : observers_) o->on_velocity(now_us, command);
  }
  void on_command(TimeUs now_us, bool evading) override {
    for (FlightObserver* o : observers_) o->on_command(now_us, evading);
  }

 private:
  std::vector<FlightObserver*> observers_;
};

}  // namespace dodgesim
