// What the tests of whole flights share.
#pragma once

#include <string>
#include <vector>

#include "sim/config/scenario.h"
#include "sim/flight/fly_throw.h"
#include "sim/flight/plan.h"
#include "sim/loop.h"
#include "tests/models.h"

namespace dodgesim {

// A scenario from a few lines of YAML.
inline Scenario scenario(const std::string& text) {
  return parse_scenario(text, "test.yaml", testing::kModels);
}

inline constexpr const char* kHover = "mission: {start_m: [-1, 0, 2], heading_deg: 30}\n";

// Throws from everywhere that the room allows, at the vehicle's centre moved by the offset.
inline Scenario thrown_from_everywhere(const std::string& mission, const std::string& offset_m) {
  return scenario(mission +
                  "throw: {distance_m: !uniform [1.5, 3], speed_mps: !uniform [3, 8],\n"
                  "  bearing_deg: !uniform [-60, 60], size_m: !choice [0.1, 0.2],\n"
                  "  spin_radps: 20, launch_height_m: !uniform [1, 2.5],\n"
                  "  launch_s: !uniform [0.2, 1.5], aim_offset_m: " +
                  offset_m + "}\nafter_s: 0.1\n");
}

inline FlightRecord fly_as(const std::string& pilot, const Scenario& scenario, FlightPlan plan,
                           FlightObserver* observer = nullptr) {
  plan.pilot = pilot;
  return fly(scenario, plan, observer);
}

// The first throw of the scenario, or the flight without one.
inline FlightRecord fly_as(const std::string& pilot, const Scenario& scenario,
                           FlightObserver* observer = nullptr) {
  return fly_as(pilot, scenario, plan_throw(scenario, 0), observer);
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
