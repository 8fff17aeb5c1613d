#include "sim/preflight/vehicle_notes.h"

#include <cmath>
#include <map>
#include <set>

#include "sim/base/formatted.h"
#include "sim/base/numbers.h"
#include "sim/config/expand.h"
#include "sim/config/pilot.h"
#include "sim/flight/setup.h"
#include "sim/preflight/placed.h"
#include "sim/world/referee.h"

namespace dodgesim {

namespace {

constexpr double kHullTolerance = 0.2;
constexpr double kBrakingMps2 = 25;  // speed_mps^2 / this is what it needs to come to rest

// "mine.yaml:3:5: KEY is 5, but ...".
std::string note(const std::string& key, double value, const std::string& but,
                 const Scenario& campaign) {
  return placed(key + " is " + to_text(value) + ", but " + but, place_of_key(key, campaign));
}

bool escapes_by_hull(const Scenario& scenario) {
  return scenario.pilot != kNoPilot && scenario.pilot != kPluginPilot &&
         scenario.dodger.escape.law != "potential_field";
}

bool swings(const Scenario& scenario) {
  const double speed_mps = scenario.mission.speed_mps;
  return scenario.mission.type != "hover" && scenario.pilot != kPluginPilot &&
         speed_mps * speed_mps > kBrakingMps2 * scenario.dodger.attractive.e_0_m;
}

}  // namespace

std::vector<std::string> vehicle_notes(const Scenario& campaign) {
  std::map<std::string, double> reach_m;  // by vehicle
  std::set<std::string> notes;
  for_each_combination(campaign, [&](const Scenario& scenario) {
    if (swings(scenario)) {
      const double speed_mps = scenario.mission.speed_mps;
      notes.insert(
          note("mission.speed_mps", speed_mps,
               formatted("dodger.attractive.e_0_m is %g: below %.3g m the nominal vehicle "
                         "swings through its goal forever.",
                         scenario.dodger.attractive.e_0_m, speed_mps * speed_mps / kBrakingMps2),
               campaign));
    }
    if (!escapes_by_hull(scenario)) return;
    const WorldSpec spec = world_spec(scenario, {});
    const std::string file = spec.vehicle_file();
    if (!reach_m.contains(file)) reach_m[file] = radius_m(Referee(World(spec)).hull());
    const double believed_m = scenario.dodger.escape.hull_radius_m;
    if (std::abs(reach_m[file] - believed_m) <= kHullTolerance * believed_m) return;
    notes.insert(note(
        "dodger.escape.hull_radius_m", believed_m,
        formatted("the hull of %s reaches %.2g m from its centre.", file.c_str(), reach_m[file]),
        campaign));
  });
  return {notes.begin(), notes.end()};
}

}  // namespace dodgesim
