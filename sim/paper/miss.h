// Why an object that was in view was not detected: the flight again, with a look into the pilot.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dodge/detect/depth.h"
#include "sim/observers/dodger_observer.h"
#include "sim/observers/event_truth.h"
#include "sim/paper/passage.h"

namespace dodgesim {

// One cycle of the pilot and the first object, at the end of the window of events.
struct ObservedCycle {
  TimeUs t_us = 0;
  double range_m = 0;
  bool centre_in_view = false;
  // By camera (mono: the first).
  std::array<int, 2> events{};    // of the window that the object made
  std::array<int, 2> clusters{};  // on its outline
  // What was located on its outline, whatever distance and size: the nearest to the truth.
  struct Location {
    double range_m = 0, size_m = 0;
  };
  std::optional<Location> location;
};

// How far the pilot got at best, from nothing to everything.
enum class Miss { kFewEvents, kNoCluster, kOneCamera, kNoMatch, kRange, kSize, kElsewhere };

// "no cluster".
std::string miss_text(Miss miss);

// Of cycles while the object was in view; kFewEvents without any. `min_events` is what the pilot
// asks of a cluster.
Miss miss_of(std::span<const ObservedCycle> cycles, const dodge::DepthConfig& limits,
             int min_events);

// Watches a flight of the paper's pilot.
class MissObserver : public DodgerObserver {
 public:
  explicit MissObserver(const Scenario& scenario);

  bool wants_causes() const override { return true; }
  void on_tick(const World& world) override;
  void on_events(int camera, const Packet& packet) override { truth_.on_events(camera, packet); }
  void on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) override;

  // Of the cycles with the object in flight.
  const std::vector<ObservedCycle>& cycles() const { return cycles_; }

 private:
  std::optional<Snapshot> state_at(TimeUs t_us) const;
  ObjectView view(const Snapshot& state, std::size_t camera) const;
  std::optional<ObservedCycle::Location> locate(const Snapshot& state, const dodge::Dodger& pilot);

  Scenario scenario_;
  CameraRig rig_;
  EventTruth truth_;
  std::optional<dodge::DepthEstimator> unlimited_;  // takes any distance and size
  double radius_m_ = 0;
  SnapshotHistory history_;
  std::vector<ObservedCycle> cycles_;
};

}  // namespace dodgesim
