// dodgesim merge: puts the shards of a campaign together.
#include <cstdio>
#include <iostream>
#include <memory>

#include "sim/campaign/merge.h"
#include "sim/files/text_table.h"
#include "tools/commands/campaign_options.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> directories;
  bool check = false;
  CampaignOptions options;
};

int merge(const MergeArguments& arguments) {
  if (arguments.check) {
    std::printf("All %s are there.\n",
                count_text(expect_complete(arguments.directories), "throw").c_str());
    return kOk;
  }
  const CampaignSummary summary = merge_campaigns(arguments.directories, arguments.options);
  std::cout << summary.table;
  std::printf("%s from %zu directories\nResults: %s\n", count_text(summary.wanted, "throw").c_str(),
              arguments.directories.size(), arguments.options.out.c_str());
  return report_errors(summary);
}

}  // namespace

void add_merge_command(CLI::App& program, const std::string& command_line, int& exit_code) {
  auto arguments = std::make_shared<MergeArguments>();
  arguments->options.command_line = command_line;
  CLI::App* command = program.add_subcommand(
      "merge", "Put the parts of a campaign together that run --shard has flown");
  command->add_option("directories", arguments->directories, "What run --out wrote, in any order")
      ->required()
      ->type_name("DIR...");
  CLI::Option_group* const target = command->add_option_group("What to do");
  target->add_option("--out", arguments->options.out, "Where the whole campaign goes")
      ->type_name("DIR");
  target->add_flag("--check", arguments->check, "Only say whether all throws are there");
  target->require_option(1);
  command->add_flag("--force", arguments->options.force, "Overwrite whatever results are in DIR");
  command->footer(
      "The tables are those that one process would have written, byte for byte. Only timing.csv,\n"
      "manifest.json, report.html and results.bin differ, which say how long it took. A part may "
      "be there twice. Parts of different scenarios or versions, "
      "and\n"
      "throws that went differently, are refused (exit 2); missing throws are listed (exit 3).\n\n"
      "Example:\n"
      "  dodgesim run s.yaml --out part0 --shard 0/2\n"
      "  dodgesim run s.yaml --out part1 --shard 1/2\n"
      "  dodgesim merge part0 part1 --out whole");
  command->callback([arguments, &exit_code] { exit_code = merge(*arguments); });
}

}  // namespace dodgesim
