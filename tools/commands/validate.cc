// dodgesim validate: is this scenario well-formed, and what does it say in full?
#include <iostream>
#include <memory>

#include "sim/config/expand.h"
#include "sim/config/idle_keys.h"
#include "sim/files/text_table.h"
#include "sim/preflight/try_models.h"
#include "sim/preflight/try_plugin.h"
#include "sim/preflight/try_throws.h"
#include "sim/preflight/vehicle_notes.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct ValidateArguments {
  std::string scenario;
  std::string models_dir;
  std::string plugin;
  bool resolved = false;
  std::vector<std::string> set;
};

void validate(const ValidateArguments& arguments) {
  const Scenario scenario = with_plugin(load_scenario(arguments.scenario, arguments.models_dir,
                                                      parse_settings("--set", arguments.set)),
                                        arguments.plugin);
  try_models({scenario});
  try_plugin(scenario);
  if (arguments.resolved) {
    std::cout << to_yaml(scenario);
    return;
  }
  for (const std::string& note : idle_keys(scenario)) std::cerr << note << "\n";
  for (const std::string& note : vehicle_notes(scenario)) std::cerr << note << "\n";
  const TriedThrows tried = try_throws(scenario);
  if (!tried.trouble.empty()) std::cerr << tried.trouble << "\n";
  std::cout << arguments.scenario << ": a valid scenario";
  if (scenario.anyone_throws()) {
    std::cout << " of " << count_text(throw_count(scenario), "throw");
    if (tried.solved == 0) {
      std::cout << " (not solved: that takes too long)";
    } else if (tried.solved < throw_count(scenario)) {
      std::cout << " (" << tried.solved << " of which were solved)";
    }
  } else {
    std::cout << " in which nobody throws";
  }
  if (!scenario.grid.empty()) {
    std::cout << ", " << count_text(cell_count(scenario), "cell");
  }
  if (!scenario.sweep.empty()) {
    std::cout << ", " << count_text(sweep_count(scenario), "value") << " of the sweep";
  }
  std::cout << ", " << pilots_of(scenario) << ".\n";
}

}  // namespace

void add_validate_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command = program.add_subcommand(
      "validate", "Check a scenario: every problem in one sentence with file, line and key");
  command->add_option("scenario", arguments->scenario, "The scenario's YAML file")
      ->required()
      ->type_name("SCENARIO.yaml");
  command->add_flag("--resolved", arguments->resolved,
                    "Print the scenario with every value spelled out; throws are not solved");
  add_set_option(*command, arguments->set);
  add_models_option(*command, arguments->models_dir);
  add_plugin_option(*command, arguments->plugin);
  command->footer(
      "Throws are solved, too, as many as it can in some 2 s, or the first if that takes no more\n"
      "than some 10 s: one that is impossible is a problem (run loses that throw only).\n"
      "Keys that have no effect are named, and are no problem.");
  command->callback([arguments, &exit_code] {
    validate(*arguments);
    exit_code = kOk;
  });
}

}  // namespace dodgesim
