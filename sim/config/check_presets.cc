#include "sim/config/check_presets.h"

#include <algorithm>
#include <optional>

#include "sim/config/pilot.h"
#include "sim/config/scenario_changes.h"

namespace dodgesim {

namespace {

// Whether a value of the axis brings other values of a group of keys than the scenario's; if so,
// the scenario with those of its own preset alone.
std::optional<Scenario> without_keys_of_preset(const Scenario& scenario, const VariedKey& axis) {
  const auto any = [&axis](const auto& differs) {
    return std::any_of(axis.values.begin(), axis.values.end(),
                       [&](const YamlNode& value) { return differs(value.text); });
  };
  const std::string dodger = dodger_preset(scenario.pilot);
  const std::string& events = scenario.sensors.events.preset;
  Scenario plain = scenario;
  if (axis.key == "pilot" && any([&](const auto& v) { return dodger_preset(v) != dodger; })) {
    plain.dodger = dodge::preset(dodger);
    return plain;
  }
  if (axis.key == "sensors.events.preset" && any([&](const auto& v) { return v != events; })) {
    plain.sensors.events = event_camera_preset(events);
    return plain;
  }
  return std::nullopt;
}

bool varies(const Scenario& scenario, const std::string& key) {
  const auto is_key = [&key](const VariedKey& axis) { return axis.key == key; };
  return std::any_of(scenario.grid.begin(), scenario.grid.end(), is_key) ||
         std::any_of(scenario.sweep.begin(), scenario.sweep.end(), is_key);
}

}  // namespace

void check_presets(const Scenario& scenario, const VariedKey& axis, ReadContext& context) {
  const std::optional<Scenario> plain = without_keys_of_preset(scenario, axis);
  if (!plain) return;
  for (const ScenarioChange& change : scenario_changes(to_yaml(*plain), to_yaml(scenario))) {
    if (varies(scenario, change.key)) continue;
    context.problems.add(context.position_of(change.key),
                         change.key + " is " + change.after + ", but other values of " + axis.key +
                             " take its place; give it in the sweep, too, for all of them: " +
                             change.key + ": [" + change.after + "].");
  }
}

}  // namespace dodgesim
