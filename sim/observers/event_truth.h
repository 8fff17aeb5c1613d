// How much of what the pilot takes for obstacles are events of an object, and how much of an
// object's events it finds: precision and recall, from the cause of every event.
//
// Counted in every cycle of the pilot while an object is in flight, over the events of its window
// and both cameras. An event is found when its compensated pixel is in the obstacle mask (panel F
// of the paper's Fig. 4) and in the rectangle of a cluster. An event of an object is one whose
// pixel shows the object, or has it beside it, as the light of such a pixel may be the object's in
// part.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "sim/observers/dodger_observer.h"
#include "sim/outcome/result.h"

namespace dodgesim {

// An event of the window of a cycle, with everything that is known about it.
struct WindowEvent {
  TimeUs t_us = 0;
  Cause cause = kCauseScene;
  int pixel = -1;      // compensated, y * width + x; -1: outside of the image
  bool found = false;  // taken for an obstacle's
};

class EventTruth : public DodgerObserver {
 public:
  bool wants_causes() const override { return true; }
  void on_tick(const World& world) override;
  void on_events(int camera, const Packet& packet) override;
  void on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) override;
  void on_command(TimeUs /*now_us*/, bool evading) override { evading_ = evading_ || evading; }

  // One for each cycle with an object in flight.
  const std::vector<EventTruthRow>& rows() const { return rows_; }

  // Of the last cycle: the events of a camera's window, in order. Empty for other pilots than
  // dodge::Dodger.
  const std::vector<WindowEvent>& window(int camera) const {
    return windows_.at(static_cast<std::size_t>(camera));
  }

 private:
  struct LabelledEvent {
    Event event;
    Cause cause;
  };

  void label_window(std::size_t camera, const dodge::Dodger& dodger);

  bool object_in_flight_ = false;
  std::array<std::deque<LabelledEvent>, 2> sent_;  // by camera; older ones are forgotten
  std::array<std::vector<WindowEvent>, 2> windows_;
  bool evading_ = false;
  std::vector<EventTruthRow> rows_;
};

}  // namespace dodgesim
