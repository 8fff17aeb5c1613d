// dodgesim replay: flies one throw of a campaign again, bit-identically.
#include <fstream>
#include <iostream>
#include <memory>

#include "sim/base/error.h"
#include "sim/campaign/csv.h"
#include "sim/loop.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct Arguments {
  std::string directory;
  std::string models_dir;
  int throw_index = 0;
};

// Line of throws.csv for this throw, with its line end.
std::string recorded_row(const std::string& path, int throw_index) {
  std::ifstream file(path);
  if (!file) throw IoError(path + " could not be opened; is this the directory of a campaign?");
  std::string line;
  for (int i = 0; i <= throw_index + 1; ++i) {
    if (!std::getline(file, line)) {
      throw ScenarioError(path + " has no throw " + std::to_string(throw_index) + ".");
    }
  }
  return line + "\n";
}

int replay(const Arguments& arguments) {
  const std::string& directory = arguments.directory;
  const Scenario scenario =
      load_scenario(directory + "/scenario.resolved.yaml", arguments.models_dir);
  const std::string recorded = recorded_row(directory + "/throws.csv", arguments.throw_index);
  const ThrowResult result = fly_throw(scenario, arguments.throw_index);
  const std::string flown = csv_row(result);
  if (flown == recorded) {
    std::cout << "Throw " << arguments.throw_index << " flew as recorded, bit for bit.\n";
    return kOk;
  }
  std::cerr << "Throw " << arguments.throw_index
            << " did not fly as recorded: was it another commit or another kind of machine?\n"
            << "recorded: " << recorded << "flown:    " << flown;
  return kBelowBar;
}

}  // namespace

void add_replay_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("replay", "Fly one throw of a campaign again");
  command->add_option("directory", arguments->directory, "What `dodgesim run --out DIR` wrote")
      ->required()
      ->type_name("DIR");
  command->add_option("--throw", arguments->throw_index, "Number of the throw, from 0")
      ->required()
      ->check(CLI::NonNegativeNumber);
  add_models_option(*command, arguments->models_dir);
  command->callback([arguments, &exit_code] { exit_code = replay(*arguments); });
}

}  // namespace dodgesim
