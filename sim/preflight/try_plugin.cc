#include "sim/preflight/try_plugin.h"

#include <map>

#include "sim/base/child_process.h"
#include "sim/base/error.h"
#include "sim/bridge/plugin.h"
#include "sim/config/expand.h"
#include "sim/config/pilot.h"
#include "sim/config/writer.h"
#include "sim/flight/setup.h"
#include "sim/preflight/placed.h"
#include "sim/world/world.h"

namespace dodgesim {

namespace {

constexpr int kWallMs = 30000;

// All that the pilot is made from.
std::string what_it_is_given(Scenario scenario) {
  Writer writer;
  writer.text("", scenario.plugin_parameters, "");
  writer.text("", scenario.vehicle, "");
  scenario.vehicle_overrides.visit(writer);
  scenario.sensors.camera.visit(writer);
  scenario.dodger.visit(writer);
  return writer.yaml();
}

// The throws' scenarios that it flies, one for each that gives it something else.
std::map<std::string, Scenario> flown_by_plugin(const Scenario& campaign) {
  std::map<std::string, Scenario> flown;
  for_each_combination(campaign, [&flown](const Scenario& scenario) {
    if (scenario.pilot == kPluginPilot) flown.try_emplace(what_it_is_given(scenario), scenario);
  });
  return flown;
}

// What is wrong with it, or nothing.
std::string complaint_about(const Scenario& scenario) {
  try {
    const World world(world_spec(scenario, {}));
    make_plugin_pilot(scenario.plugin, core_config(scenario, world.vehicle()),
                      scenario.plugin_parameters);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

void try_making(const Scenario& scenario) {
  // First a byte that says that it got to its end.
  const ChildAnswer answer =
      ask_child([&scenario] { return "." + complaint_about(scenario); }, kWallMs);
  const std::string subject = "The plug-in " + scenario.plugin.file;
  if (!answer.in_time) {
    throw ScenarioError(subject + " takes longer than " + std::to_string(kWallMs / 1000) +
                        " s to make a pilot.");
  }
  if (answer.said.empty()) {
    throw ScenarioError(subject +
                        " crashes while it is loaded, makes a pilot or deletes it again.");
  }
  if (answer.said.size() > 1) throw ScenarioError(answer.said.substr(1));
}

}  // namespace

void try_plugin(const Scenario& campaign) {
  const std::string& file = campaign.plugin.file;
  if (!flies_plugin(campaign)) {
    if (file.empty()) return;
    throw ScenarioError("--plugin " + file + ": The scenario flies other pilots; --set pilot=" +
                        kPluginPilot + " makes it fly this one.");
  }
  if (file.empty()) {
    throw ScenarioError(placed(std::string("pilot is ") + kPluginPilot +
                                   ", but no library is given: add --plugin FILE.so.",
                               place_of_key("pilot", campaign)));
  }
  for (const auto& [given, scenario] : flown_by_plugin(campaign)) try_making(scenario);
}

}  // namespace dodgesim
