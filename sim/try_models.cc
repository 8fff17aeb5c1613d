#include "sim/try_models.h"

#include <map>
#include <set>
#include <string>

#include "sim/config/expand.h"
#include "sim/world/model_trial.h"

namespace dodgesim {

namespace {

// A size that every kind of object can have.
constexpr double kTrialSizeM = 0.2;

}  // namespace

void try_models(const Scenario& campaign) {
  std::map<std::string, WorldSpec> worlds;  // each kind once
  std::set<std::string> kinds;
  const int throws_of_a_value = cell_count(campaign) * campaign.repeats;
  for (int sweep = 0; sweep < sweep_count(campaign); ++sweep) {
    for (int cell = 0; cell < cell_count(campaign); ++cell) {
      const Scenario scenario = case_of(campaign, sweep * throws_of_a_value + cell).scenario;
      WorldSpec world;
      world.models_dir = scenario.models_dir;
      world.room = scenario.room;
      world.vehicle = scenario.vehicle;
      world.vehicle_overrides = scenario.vehicle_overrides;
      const VehicleOverrides& o = scenario.vehicle_overrides;
      const std::string name = scenario.room + "/" + scenario.vehicle + "/" +
                               std::to_string(o.mass_scale) + "/" + std::to_string(o.max_thrust_n) +
                               "/" + std::to_string(o.inertia_scale);
      worlds.emplace(name, world);
      for (const ThrowSpec& spec : scenario.throw_specs()) {
        kinds.insert(spec.object.names.begin(), spec.object.names.end());
      }
    }
  }
  for (auto& [name, world] : worlds) {
    for (const std::string& kind : kinds) world.objects.push_back({kind, kTrialSizeM});
    try_world(world);
  }
}

}  // namespace dodgesim
