#include "sim/config/check_presets.h"

#include <algorithm>
#include <string>

#include "sim/base/contains.h"
#include "sim/config/dotted_keys.h"
#include "sim/config/pilot.h"

namespace dodgesim {

namespace {

// A key whose value decides on the defaults of a group of keys.
struct Preset {
  std::string key, group;

  bool same(const std::string& a, const std::string& b) const {
    return key == "pilot" ? dodger_preset(a) == dodger_preset(b) : a == b;
  }
  bool has(const std::string& of_group) const {
    return of_group.starts_with(group + ".") && of_group != key;
  }
};

const Preset kPilot = {"pilot", "dodger"};
const Preset kCamera = {"sensors.events.preset", "sensors.events"};

// Of a dotted key; empty if it is not there.
std::string text_at(const YamlNode& root, const std::string& key) {
  const YamlNode* node = &root;
  for (std::size_t begin = 0; node != nullptr && begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    node = node->find(key.substr(begin, end - begin));
    begin = end + 1;
  }
  return node == nullptr ? "" : node->text;
}

// As a resolved scenario does, which does not tell the keys that somebody chose from defaults.
bool gives_all_keys(const Preset& preset, const ReadContext& context) {
  return std::ranges::all_of(context.all_keys, [&](const auto& key) {
    return !preset.has(key) || context.where.contains(key);
  });
}

void check_set_preset(const Preset& preset, const YamlNode& file, const YamlNode& root,
                      ReadContext& context) {
  const std::string before = text_at(file, preset.key), now = text_at(root, preset.key);
  if (before.empty() || preset.same(now, before) || !gives_all_keys(preset, context)) return;
  const std::string change =
      now.empty() ? " is left out instead of " : " is " + now + " instead of ";
  context.add_problem(
      now.empty() ? preset.group : preset.key,
      preset.key + change + before + " by its name only: the file sets all keys of " +
          preset.group + " itself. Put --set '" + preset.group + "=~' in front to take them away.");
}

bool varies(const Scenario& scenario, const std::string& key) {
  return contains(scenario.grid, key, &VariedKey::key) ||
         contains(scenario.sweep, key, &VariedKey::key);
}

void check_varied_preset(const Preset& preset, const std::string& own, const Scenario& scenario,
                         const VariedKey& axis, ReadContext& context) {
  const auto other = std::ranges::find_if(
      axis.values, [&](const YamlNode& value) { return !preset.same(value.text, own); });
  if (other == axis.values.end() || gives_all_keys(preset, context)) return;
  for (const auto& [key, at] : context.where) {
    if (!preset.has(key) || is_group(context.where, key) || varies(scenario, key)) continue;
    context.problems.add(at, key + " is given, but " + preset.key + " " + other->text +
                                 " brings its own; to hold for all values of " + preset.key +
                                 " it must stand there, too, as a list of one value.");
  }
}

}  // namespace

void check_set_presets(const YamlNode& file, const YamlNode& root, ReadContext& context) {
  for (const Preset* const preset : {&kPilot, &kCamera}) {
    check_set_preset(*preset, file, root, context);
  }
}

void check_varied_presets(const Scenario& scenario, ReadContext& context) {
  for (const VariedKeys* const axes : {&scenario.grid, &scenario.sweep}) {
    for (const VariedKey& axis : *axes) {
      if (axis.key == kPilot.key) {
        check_varied_preset(kPilot, scenario.pilot, scenario, axis, context);
      } else if (axis.key == kCamera.key) {
        check_varied_preset(kCamera, scenario.sensors.events.preset, scenario, axis, context);
      }
    }
  }
}

}  // namespace dodgesim
