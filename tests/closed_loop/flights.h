// What the tests of whole flights share.
#pragma once

#include <string>
#include <vector>

#include "sim/config/scenario.h"
#include "sim/loop.h"
#include "tests/models.h"

namespace dodgesim {

// A scenario from a few lines of YAML.
inline Scenario scenario(const std::string& text) {
  return parse_scenario(text, "test.yaml", testing::kModels);
}

// Keeps the true states of a flight, one a tick.
class Diary : public FlightObserver {
 public:
  void on_tick(const World& world) override { snapshots_.push_back(world.snapshot()); }

  const std::vector<Snapshot>& snapshots() const { return snapshots_; }

  // The truth at any instant of the flight after its first tick.
  Snapshot at(TimeUs t_us) const {
    const auto tick = static_cast<std::size_t>((t_us + kTickUs - 1) / kTickUs - 1);
    return interpolate(snapshots_.at(tick - 1), snapshots_.at(tick), t_us);
  }

 private:
  std::vector<Snapshot> snapshots_;
};

}  // namespace dodgesim
