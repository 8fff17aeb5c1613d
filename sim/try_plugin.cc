#include "sim/try_plugin.h"

#include <map>

#include "sim/base/child_process.h"
#include "sim/base/error.h"
#include "sim/config/expand.h"
#include "sim/flight.h"

namespace dodgesim {

namespace {

constexpr int kWallMs = 30000;

// The throws' scenarios that it flies, one for each text of its parameters.
std::map<std::string, Scenario> flown_by_plugin(const Scenario& campaign) {
  std::map<std::string, Scenario> flown;
  const int throws_of_a_value = cell_count(campaign) * campaign.repeats;
  for (int sweep = 0; sweep < sweep_count(campaign); ++sweep) {
    for (int cell = 0; cell < cell_count(campaign); ++cell) {
      Scenario scenario = case_of(campaign, sweep * throws_of_a_value + cell).scenario;
      if (scenario.pilot != kPluginPilot) continue;
      const std::string parameters = scenario.plugin_parameters;
      flown.try_emplace(parameters, std::move(scenario));
    }
  }
  return flown;
}

// What is wrong with it, or nothing.
std::string complaint_about(const Scenario& scenario) {
  try {
    const World world(world_spec(scenario, {}));
    make_pilot(scenario.plugin, core_config(scenario, world.vehicle()), scenario.plugin_parameters);
  } catch (const SimulationError& error) {
    return error.what();
  } catch (const std::exception& error) {
    return "The plug-in " + scenario.plugin.file + " made no pilot: " + error.what();
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
  if (answer.said.empty()) throw ScenarioError(subject + " crashes while it makes a pilot.");
  if (answer.said.size() > 1) throw ScenarioError(answer.said.substr(1));
}

}  // namespace

void try_plugin(const Scenario& campaign) {
  const std::map<std::string, Scenario> flown = flown_by_plugin(campaign);
  const std::string& file = campaign.plugin.file;
  if (flown.empty() && !file.empty()) {
    throw ScenarioError("--plugin " + file + ": The scenario flies other pilots; --set pilot=" +
                        kPluginPilot + " makes it fly this one.");
  }
  if (!flown.empty() && file.empty()) {
    const auto at = campaign.places.find("pilot");
    throw ScenarioError((at == campaign.places.end() ? "" : at->second + ": ") + "pilot is " +
                        kPluginPilot + ", but no library is given: add --plugin FILE.so.");
  }
  for (const auto& [parameters, scenario] : flown) try_making(scenario);
}

}  // namespace dodgesim
