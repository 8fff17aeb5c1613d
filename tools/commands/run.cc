// dodgesim run: flies a campaign.
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include "sim/campaign/campaign.h"
#include "sim/campaign/progress.h"
#include "sim/event_truth.h"
#include "sim/loop.h"
#include "sim/render/osmesa_context.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct Arguments {
  std::string scenario;
  std::string models_dir;
  CampaignOptions options;
  std::optional<int> throws;
  std::optional<std::uint64_t> seed;
};

ThrowResult fly_with_truth(const Scenario& scenario, int index) {
  EventTruth truth;
  ThrowResult result = fly_throw(scenario, index, &truth);
  result.truth_rows = truth.rows();
  for (EventTruthRow& row : result.truth_rows) row.throw_index = index;
  return result;
}

void warn_of_lost_events(const std::vector<ThrowResult>& results) {
  std::int64_t lost = 0;
  int throws = 0;
  for (const ThrowResult& result : results) {
    const std::int64_t of_throw = result.events_lost[0] + result.events_lost[1];
    lost += of_throw;
    throws += of_throw > 0 ? 1 : 0;
  }
  if (lost == 0) return;
  std::printf(
      "The event cameras' readout (sensors.events.readout_max_hz) lost %lld events in %s.\n",
      static_cast<long long>(lost), count_of_throws(throws).c_str());
}

int run(const Arguments& arguments) {
  Scenario scenario = load_scenario(arguments.scenario, arguments.models_dir);
  if (arguments.throws) scenario.repeats = *arguments.throws;
  if (arguments.seed) scenario.seed = *arguments.seed;

  CampaignOptions options = arguments.options;
  options.show_progress = ::isatty(STDERR_FILENO) == 1;
  options.gl_renderer = [] { return OsmesaContext(GlProfile::kCore33, 1, 1).renderer(); };
  const CampaignSummary summary = run_campaign(scenario, options, [&](int index) {
    return options.truth ? fly_with_truth(scenario, index) : fly_throw(scenario, index);
  });

  std::cout << summary.table;
  std::printf("%s in %s; real-time factor of the closed loop on one core: %.2f\nResults: %s\n",
              count_of_throws(scenario.repeats).c_str(), duration_text(summary.wall_s).c_str(),
              summary.real_time_factor, options.out.c_str());
  warn_of_lost_events(summary.results);
  if (options.truth) std::cout << truth_text(summary.truth) << "\n";
  if (summary.errors == 0) return kOk;
  std::cerr << count_of_throws(summary.errors)
            << " could not be flown; see \"Errors\" in the table.\n";
  return kIncomplete;
}

}  // namespace

void add_run_command(CLI::App& program, const std::string& command_line, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CampaignOptions& options = arguments->options;
  options.command_line = command_line;
  options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));

  CLI::App* command =
      program.add_subcommand("run", "Fly all throws of a scenario and write tables of success");
  command->add_option("scenario", arguments->scenario, "The scenario's YAML file")
      ->required()
      ->type_name("SCENARIO.yaml");
  command->add_option("--out", options.out, "Where the results go; made when missing")
      ->required()
      ->type_name("DIR");
  command->add_option("-j,--jobs", options.jobs, "Worker processes; results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--throws", arguments->throws, "Number of throws, in place of repeats")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--seed", arguments->seed, "Seed, in place of the scenario's");
  command->add_flag("--force", options.force, "Overwrite results of another scenario in DIR");
  command->add_flag("--truth", options.truth,
                    "Also write truth.csv: of the events that the pilot takes for an obstacle's,\n"
                    "how many an object made, and of those that it made, how many are found");
  add_models_option(*command, arguments->models_dir);
  command->footer(
      "Writes to DIR: table.md and table.csv (dodged / would have hit, with 95 % intervals),\n"
      "throws.csv (a row a throw), detections.csv, timing.csv, scenario.resolved.yaml and\n"
      "manifest.json (commit, versions, machine).\n\n"
      "Examples:\n"
      "  dodgesim run scenarios/demo.yaml --out out/demo\n"
      "  dodgesim run scenarios/demo.yaml --out out/quick --throws 4 -j 2\n"
      "  dodgesim replay out/demo --throw 3 --video throw3.mp4     look at one of them");
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace dodgesim
