#include "sim/config/check_presets.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "sim/config/pilot.h"

namespace dodgesim {

namespace {

struct SweptPreset {
  std::string group;  // of keys that it brings
  std::string name;   // of the scenario's own
  std::string (*of)(const std::string& value);
};

std::optional<SweptPreset> preset_of(const Scenario& scenario, const std::string& key) {
  if (key == "pilot") return SweptPreset{"dodger", dodger_preset(scenario.pilot), dodger_preset};
  if (key != "sensors.events.preset") return std::nullopt;
  return SweptPreset{"sensors.events", scenario.sensors.events.preset,
                     [](const std::string& value) { return value; }};
}

bool varies(const Scenario& scenario, const std::string& key) {
  const auto is_key = [&key](const VariedKey& axis) { return axis.key == key; };
  return std::any_of(scenario.grid.begin(), scenario.grid.end(), is_key) ||
         std::any_of(scenario.sweep.begin(), scenario.sweep.end(), is_key);
}

// The keys with a value of their own that the scenario gives of a group; none if it gives all, as
// a resolved scenario does, which says nothing of what anybody wanted.
std::vector<std::string> given_keys(const std::string& group, const std::string& but,
                                    const ReadContext& context) {
  std::vector<std::string> given;
  bool all = true;
  for (const std::string& key : context.all_keys) {
    if (!key.starts_with(group + ".") || key == but) continue;
    all = all && context.where.contains(key);
    const auto below = context.where.lower_bound(key + ".");
    const bool is_group = below != context.where.end() && below->first.starts_with(key + ".");
    if (context.where.contains(key) && !is_group) given.push_back(key);
  }
  return all ? std::vector<std::string>() : given;
}

}  // namespace

void check_presets(const Scenario& scenario, const VariedKey& axis, ReadContext& context) {
  const std::optional<SweptPreset> preset = preset_of(scenario, axis.key);
  if (!preset) return;
  const auto other =
      std::find_if(axis.values.begin(), axis.values.end(),
                   [&](const YamlNode& value) { return preset->of(value.text) != preset->name; });
  if (other == axis.values.end()) return;
  for (const std::string& key : given_keys(preset->group, axis.key, context)) {
    if (varies(scenario, key)) continue;
    context.problems.add(context.position_of(key),
                         key + " is given, but " + axis.key + " " + other->text +
                             " brings its own; to hold for all values of " + axis.key +
                             " it must stand in the sweep, too, as a list of one value.");
  }
}

}  // namespace dodgesim
