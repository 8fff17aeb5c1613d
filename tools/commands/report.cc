// dodgesim report: the page that shows a campaign.
#include <iostream>
#include <memory>

#include "sim/base/error.h"
#include "sim/campaign/campaign_files.h"
#include "sim/campaign/load_campaign.h"
#include "sim/files/output_file.h"
#include "sim/tables/report.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct ReportArguments {
  std::string directory;
  std::string out;
};

int report(const ReportArguments& arguments) {
  const std::string own = arguments.directory + "/" + kReportFile;
  const std::string out = arguments.out.empty() ? own : arguments.out;
  std::error_code neither_exists;
  if (belongs_to_campaign(out) && out != own &&
      !std::filesystem::equivalent(out, own, neither_exists)) {
    throw ScenarioError("--out " + out + " would overwrite a file of another campaign.");
  }
  const LoadedCampaign campaign = load_campaign(arguments.directory);
  write_file(out, report_html(campaign, arguments.directory));
  std::cout << "Report: " << out << "\n";
  return completeness(arguments.directory, campaign);
}

}  // namespace

void add_report_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = program.add_subcommand(
      "report", "Make the page that shows a campaign, with every throw in 3-D");
  command->add_option("directory", arguments->directory, "What `dodgesim run --out DIR` wrote")
      ->required()
      ->type_name("DIR");
  command->add_option("--out", arguments->out, "Where it goes; DIR/report.html when not given")
      ->check(file_ending(".html"))
      ->type_name("FILE.html");
  command->footer(
      "One file that any browser opens, offline. `run` and `merge` make it at their end; this\n"
      "command also makes it of a campaign under way.\n\n"
      "Example:\n"
      "  dodgesim report out/demo");
  command->callback([arguments, &exit_code] { exit_code = report(*arguments); });
}

}  // namespace dodgesim
