// dodgesim run: flies a campaign.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>

#include "sim/base/error.h"
#include "sim/base/progress.h"
#include "sim/config/expand.h"
#include "sim/config/pilot.h"
#include "sim/files/text_table.h"
#include "sim/preflight/try_models.h"
#include "sim/preflight/try_plugin.h"
#include "sim/tables/report.h"
#include "tools/commands/campaign_options.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace fs = std::filesystem;

namespace {

struct RunArguments {
  std::string scenario;
  std::string models_dir;
  std::string plugin;
  CampaignOptions options;
  RepeatOptions repeat;
  std::vector<std::string> set;
  std::vector<std::string> over;
  std::string shard;
};

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
      static_cast<long long>(lost), count_text(throws, "throw").c_str());
}

// By value of the sweep, which must not be pooled.
void print_truth(const Scenario& scenario, const std::vector<EventTruthSums>& truth) {
  const int throws_of_a_value = throw_count(scenario) / sweep_count(scenario);
  for (std::size_t sweep = 0; sweep < truth.size(); ++sweep) {
    const ThrowCase first = case_of(scenario, static_cast<int>(sweep) * throws_of_a_value);
    if (!first.sweep_values.empty()) std::cout << label(first.sweep_values) << ":\n";
    if (!perceives(first.scenario.pilot)) {
      std::cout << "The pilot " << first.scenario.pilot << " sees no events.\n";
    } else if (first.scenario.pilot == kPluginPilot) {
      std::cout
          << "Which events a plug-in takes for an obstacle's is not known: truth.csv has none.\n";
    } else {
      std::cout << truth_text(truth[sweep]) << "\n";
    }
  }
}

// Whether the bracket that opens the text is closed at its end only: [0.1, 0.2], but not [0, 0],
// [1, 0].
bool is_one_list(std::string text) {
  text.erase(text.find_last_not_of(" \t") + 1);
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '[' ? 1 : 0;
    depth -= text[i] == ']' ? 1 : 0;
    if (depth == 0) return i > 0 && i + 1 == text.size();
  }
  return false;
}

// What the command line changes about the file, in the order in which it counts.
std::vector<Setting> settings_of(const RunArguments& arguments) {
  std::vector<Setting> settings = parse_settings("--set", arguments.set);
  std::set<std::string> swept;
  for (Setting& setting : parse_settings("--over", arguments.over)) {
    constexpr std::string_view kThrow = "throw.";  // a prefix that keys of a sweep may leave out
    const std::size_t skipped = setting.key.starts_with(kThrow) ? kThrow.size() : 0;
    if (!swept.insert(setting.key.substr(skipped)).second) {
      throw ScenarioError(setting.shown + ": " + setting.key +
                          " is swept already; give all its values in one --over.");
    }
    setting.key = "sweep." + setting.key;
    if (!is_one_list(setting.value)) setting.value = "[" + setting.value + "]";
    settings.push_back(std::move(setting));
  }
  append_settings(arguments.repeat, settings);
  return settings;
}

int run(const RunArguments& arguments) {
  const Scenario scenario =
      with_plugin(load_scenario(arguments.scenario, arguments.models_dir, settings_of(arguments)),
                  arguments.plugin);

  CampaignOptions options = arguments.options;
  if (!arguments.shard.empty()) {
    options.shard =
        parse_shard(arguments.shard, [](const char* name) { return std::getenv(name); });
  }
  try_models({scenario});
  try_plugin(scenario);
  const CampaignSummary summary = fly_campaign(scenario, options);
  if (!summary.complete()) return report_stop(summary, options);
  std::cout << summary.table;
  // The others were there already.
  const std::string part =
      summary.flown < summary.wanted ? std::to_string(summary.flown) + " of " : "";
  std::printf(
      "%s%s in %s; real-time factor of the closed loop on one core: %.*f\nResults: %s\n"
      "Report, for any browser: %s\n",
      part.c_str(), count_text(summary.wanted, "throw").c_str(),
      duration_text(summary.wall_s).c_str(), summary.real_time_factor < 0.1 ? 4 : 2,
      summary.real_time_factor, options.out.c_str(), (options.out / kReportFile).c_str());
  if (summary.memory.first_mb > 0) {
    std::printf("Memory of a worker: %.0f MB after its first throw, %.0f MB after its last\n",
                summary.memory.first_mb, summary.memory.last_mb);
  }
  warn_of_lost_events(summary.results);
  if (options.truth) print_truth(scenario, summary.truth);
  return report_errors(summary);
}

// What run and sweep share.
CLI::App* add_campaign_command(CLI::App& program, const std::string& name, const std::string& what,
                               const std::string& command_line,
                               const std::shared_ptr<RunArguments>& arguments) {
  CampaignOptions& options = arguments->options;
  options.command_line = command_line;
  CLI::App* command = program.add_subcommand(name, what);
  command->add_option("scenario", arguments->scenario, "The scenario's YAML file")
      ->required()
      ->type_name("SCENARIO.yaml");
  add_campaign_options(*command, "SCENARIO", options);
  add_repeat_options(*command, arguments->repeat,
                     "Number of throws (with a grid, of each cell), in place of repeats",
                     "Seed, in place of the scenario's");
  add_set_option(*command, arguments->set);
  command
      ->add_option("--shard", arguments->shard,
                   "Fly only a part: INDEX/COUNT (from 0), auto/COUNT (the index from\n"
                   "SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX or AWS_BATCH_JOB_ARRAY_INDEX) or\n"
                   "auto (Slurm: the count, too); see dodgesim merge")
      ->type_name("PART");
  command->add_flag("--truth", options.truth,
                    "Also write truth.csv: of the events that the pilot takes for an obstacle's,\n"
                    "how many an object made, and of those that it made, how many are found");
  add_models_option(*command, arguments->models_dir);
  add_plugin_option(*command, arguments->plugin);
  return command;
}

}  // namespace

void add_run_command(CLI::App& program, const std::string& command_line, int& exit_code) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = add_campaign_command(
      program, "run", "Fly all throws of a scenario and write tables of success", command_line,
      arguments);
  command->footer(
      "Writes to DIR: table.md and table.csv (dodged / would have hit, with 95 % intervals),\n"
      "report.html (charts, and every throw in 3-D), throws.csv (a row a throw), objects.csv (a\n"
      "row an object), detections.csv, timing.csv, scenario.resolved.yaml and manifest.json\n"
      "(commit, versions, machine). results.bin has every result as it comes: after Ctrl-C, a "
      "kill\n"
      "or a full disk, --resume goes on from there. A throw that crashes, hangs or needs too much\n"
      "memory fails with its reason and never counts as a success.\n\n"
      "Examples:\n"
      "  dodgesim run scenarios/demo.yaml                          results in out/demo\n"
      "  dodgesim run scenarios/demo.yaml --out out/quick --throws 4 -j 2\n"
      "  dodgesim run scenarios/demo.yaml --out out/fast --set 'throw.speed_mps=!uniform [8, 10]'\n"
      "  dodgesim replay out/demo --throw 3 --video throw3.mp4     look at one of them");
  command->callback([arguments, &exit_code] {
    set_default_out(fs::path(arguments->scenario).stem(), arguments->options);
    exit_code = run(*arguments);
  });
}

void add_sweep_command(CLI::App& program, const std::string& command_line, int& exit_code) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = add_campaign_command(
      program, "sweep", "Fly the same throws again with each of several values of a key",
      command_line, arguments);
  command
      ->add_option("--over", arguments->over,
                   "A key and its values, lists as [0,0,1],[0,0,2] or [[0,0,1]]; with several of\n"
                   "these, every combination")
      ->required()
      ->type_name("KEY=VALUE,VALUE,...")
      ->allow_extra_args(false);
  command->footer(
      "The same as run with the key sweep in the scenario. Every value meets the same throws with\n"
      "the same noise. The tables have a part for each value; throws.csv names it in every row.\n\n"
      "Examples:\n"
      "  dodgesim sweep scenarios/demo.yaml --out out/demo_latency --over "
      "delays.compute_us=0,3500,9000\n"
      "  dodgesim sweep scenarios/demo.yaml --out out/speed --over throw.speed_mps=4,6,8\n"
      "  dodgesim sweep scenarios/demo.yaml --out out/pilots --over pilot=falanga2020,oracle");
  command->callback([arguments, &exit_code] {
    set_default_out(fs::path(arguments->scenario).stem(), arguments->options);
    exit_code = run(*arguments);
  });
}

}  // namespace dodgesim
