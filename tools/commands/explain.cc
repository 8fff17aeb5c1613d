// dodgesim explain: what a key of a scenario means.
#include <iostream>
#include <memory>

#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct ExplainArguments {
  std::string key;
  bool markdown = false;
};

}  // namespace

void add_explain_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<ExplainArguments>();
  CLI::App* command =
      program.add_subcommand("explain", "Say what a key of a scenario means, or list all keys");
  CLI::Option* key = command->add_option(
      "key", arguments->key,
      "A key (throw.size_m, or size_m alone) or a group (throw); all when left out");
  command
      ->add_flag("--markdown", arguments->markdown,
                 "Print all keys as the tables of scenarios/README.md")
      ->excludes(key);
  command->footer(
      "Examples:\n"
      "  dodgesim explain throw                the keys of a throw\n"
      "  dodgesim explain compute_us           one key, wherever it stands");
  command->callback([arguments, &exit_code] {
    std::cout << (arguments->markdown ? to_markdown(scenario_docs())
                                      : explain(scenario_docs(), arguments->key));
    exit_code = kOk;
  });
}

}  // namespace dodgesim
