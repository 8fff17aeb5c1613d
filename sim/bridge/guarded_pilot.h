// A pilot that the simulator did not make itself.
#pragma once

#include <exception>
#include <memory>
#include <string>

#include "dodge/pilot.h"

namespace dodgesim {

// The exception's text as one line of UTF-8 that ends in a full stop.
std::string sentence_of(const std::exception& error);

// What it means that a pilot threw std::bad_alloc, as the end of a sentence about it.
std::string threw_bad_alloc();

// Passes everything on. What the pilot throws becomes a SimulationError, which costs the flight;
// std::bad_alloc becomes a MemoryError. A SimulationError, too: a velocity, or a number that is
// logged of a detection (all but p_W and distance_per_depth), that is no number or out of all
// proportion; a time stamp in the future; a detection before the flight began.
class GuardedPilot : public dodge::Pilot {
 public:
  explicit GuardedPilot(std::unique_ptr<dodge::Pilot> pilot) : pilot_(std::move(pilot)) {}
  ~GuardedPilot() override;

  void add_events(int camera, std::span<const dodge::Event> events) override;
  void add_imu(const dodge::ImuSample& sample) override;
  void add_state(const dodge::StateEstimate& state) override;
  void add_range(const dodge::RangeReading& reading) override;
  void set_goal(const dodge::Goal& goal) override;
  dodge::VelocityCommand update(dodge::TimeUs now_us) override;
  std::span<const dodge::Detection> detections() const override;
  std::span<const dodge::Obstacle> obstacles() const override;

 private:
  std::unique_ptr<dodge::Pilot> pilot_;
};

}  // namespace dodgesim
