#include "tools/commands/detect_scenario.h"

#include <cstdio>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/joined.h"
#include "sim/config/expand.h"
#include "sim/config/pilot.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

const std::vector<std::string> kPilotKeys = {"pilot", "plugin_parameters", "dodger", "delays"};

// A file may hold other keys: it is that of a flight. On the command line they are a mistake.
void name_idle_keys(const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    std::string key = setting.key;
    for (const std::string list : {"grid", "sweep"}) {
      if (key.starts_with(list + ".")) key.erase(0, list.size() + 1);
    }
    const std::string group = key.substr(0, key.find('.'));
    if (contains(kPilotKeys, group) || key == "grid" || key == "sweep") continue;
    std::fprintf(stderr, "%s has no effect on a recording, but %s have.\n", setting.shown.c_str(),
                 joined(kPilotKeys, {}, " and ").c_str());
  }
}

// The scenario of a recording, which is one: grid and sweep may have one value of a pilot's key.
Scenario with_single_values(const Scenario& scenario) {
  if (const VariedKey* const varied = find_varied(scenario, kPilotKeys)) {
    const bool in_grid = contains(scenario.grid, varied->key, &VariedKey::key);
    throw ScenarioError("The scenario has several values of " + varied->key +
                        ": choose one, such as --set '" + (in_grid ? "grid." : "sweep.") +
                        varied->key + "=[" + to_text(varied->values.back()) + "]'.");
  }
  return case_of(scenario, 0).scenario;
}

}  // namespace

Scenario detect_scenario(const std::string& file, const std::vector<Setting>& settings,
                         const std::string& plugin) {
  const Scenario read = file.empty() ? parse_scenario("pilot: " + std::string(kPaperPilot),
                                                      "the defaults", "", settings)
                                     : load_scenario(file, "", settings);
  Scenario scenario = with_plugin(with_single_values(read), plugin);
  name_idle_keys(settings);
  if (!perceives(scenario.pilot)) {
    throw ScenarioError("The pilot " + scenario.pilot +
                        " sees nothing in a recording; --set pilot=falanga2020, dodgesim or "
                        "plugin.");
  }
  if ((scenario.pilot == kPluginPilot) == plugin.empty()) {
    throw ScenarioError("The pilot plugin and --plugin FILE.so go together.");
  }
  return scenario;
}

}  // namespace dodgesim
