// dodgesim validate: is this scenario well-formed, and what does it say in full?
#include <iostream>
#include <memory>

#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct Arguments {
  std::string scenario;
  std::string models_dir;
  bool resolved = false;
};

void validate(const Arguments& arguments) {
  const Scenario scenario = load_scenario(arguments.scenario, arguments.models_dir);
  if (arguments.resolved) {
    std::cout << to_yaml(scenario);
    return;
  }
  std::cout << arguments.scenario << ": a valid scenario";
  if (scenario.toss) {
    std::cout << " of " << count_of_throws(scenario.repeats) << ", pilot " << scenario.pilot
              << ".\n";
  } else {
    std::cout << " in which nobody throws, pilot " << scenario.pilot << ".\n";
  }
}

}  // namespace

void add_validate_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(
      "validate", "Check a scenario: every problem in one sentence with file, line and key");
  command->add_option("scenario", arguments->scenario, "The scenario's YAML file")
      ->required()
      ->type_name("SCENARIO.yaml");
  command->add_flag("--resolved", arguments->resolved,
                    "Print the scenario with every value spelled out");
  add_models_option(*command, arguments->models_dir);
  command->callback([arguments, &exit_code] {
    validate(*arguments);
    exit_code = kOk;
  });
}

}  // namespace dodgesim
