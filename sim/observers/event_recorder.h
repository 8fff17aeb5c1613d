// Writes a camera's events with their causes.
#pragma once

#include <memory>
#include <string>

#include "sim/flight/flight_observer.h"
#include "sim/recordings/event_writer.h"

namespace dodgesim {

// No flight that scenarios can ask for is longer: the duration of its recording.
inline constexpr TimeUs kLongestFlightUs = 3600'000'000;

class EventRecorder : public FlightObserver {
 public:
  EventRecorder(const std::string& path, const Recording& recording, int camera)
      : writer_(make_event_writer(path, recording)), camera_(camera) {}
  bool wants_causes() const override { return true; }
  void on_events(int camera, const Packet& packet) override {
    if (camera != camera_) return;
    writer_->add(packet.events, packet.causes);
    count_ += packet.events.size();
  }
  void commit() { writer_->commit(); }
  std::size_t count() const { return count_; }

 private:
  std::unique_ptr<EventWriter> writer_;
  int camera_;
  std::size_t count_ = 0;
};

}  // namespace dodgesim
