#include "tools/commands/campaign_options.h"

#include <algorithm>
#include <iostream>
#include <thread>

#include "sim/base/progress.h"
#include "sim/files/text_table.h"
#include "sim/flight/fly_throw.h"
#include "sim/observers/event_truth.h"
#include "sim/preflight/try_models.h"
#include "sim/render/osmesa_context.h"
#include "tools/commands/command.h"
#include "tools/commands/stop_signal.h"

namespace dodgesim {

namespace {

ThrowResult fly_with_truth(const Scenario& scenario, int index) {
  EventTruth truth;
  ThrowResult result = fly_throw(scenario, index, &truth);
  result.truth_rows = truth.rows();
  for (EventTruthRow& row : result.truth_rows) row.throw_index = index;
  return result;
}

const std::filesystem::path kDefaultOut = "out";

}  // namespace

void add_campaign_options(CLI::App& command, const std::string& by_default,
                          CampaignOptions& options) {
  options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  constexpr double kTimeLimitS = 600;
  constexpr std::int64_t kMemoryLimitMb = 4096;
  options.limits = {kTimeLimitS, kMemoryLimitMb};
  command
      .add_option(
          "--out", options.out,
          "Where the results go; made when missing [" + (kDefaultOut / by_default).string() + "]")
      ->type_name("DIR");
  command.add_option("-j,--jobs", options.jobs, "Worker processes; results do not depend on it")
      ->check(whole_number_between(1, 1024))
      ->capture_default_str();
  CLI::Option* force =
      command.add_flag("--force", options.force, "Start anew, whatever results are in DIR");
  command
      .add_flag(
          "--resume", options.resume,
          "Fly only the throws that DIR has no results of, or\nwhose worker died or was stopped")
      ->excludes(force);
  command
      .add_option("--time-limit", options.limits.wall_s,
                  "Seconds, by the clock on the wall, after which a throw is\ngiven up; 0: never")
      ->check(number_between(0, 1e6))
      ->capture_default_str();
  command
      .add_option("--memory-limit", options.limits.memory_mb,
                  "Address space of a worker [MB]; a throw that needs more fails; 0: no limit")
      ->check(whole_number_between(0, 1000000))
      ->capture_default_str();
}

void set_default_out(const std::filesystem::path& name, CampaignOptions& options) {
  if (options.out.empty()) options.out = kDefaultOut / name;
}

void add_repeat_options(CLI::App& command, RepeatOptions& options, const std::string& throws_help,
                        const std::string& seed_help) {
  command.add_option("--throws", options.throws, throws_help)->type_name("INT");
  command.add_option("--seed", options.seed, seed_help)->type_name("UINT");
}

void append_settings(const RepeatOptions& options, std::vector<Setting>& settings) {
  const auto append = [&settings](const std::string& option, const char* key,
                                  const std::string& value) {
    if (!value.empty()) settings.push_back({key, value, option + " " + value});
  };
  append("--throws", "repeats", options.throws);
  append("--seed", "seed", options.seed);
}

PlannedCampaign plan_campaign(const Scenario& scenario, CampaignOptions options) {
  options.models = digest_of_models(scenario);
  options.plugin = scenario.plugin.digest;
  options.stop = asked_to_stop;
  options.show_progress = Progress::on_terminal();
  options.gl_renderer = renderer_name;
  const bool truth = options.truth;
  return {&scenario, std::move(options), [&scenario, truth](int index) {
            return truth ? fly_with_truth(scenario, index) : fly_throw(scenario, index);
          }};
}

void fly_campaigns(const std::vector<PlannedCampaign>& plans, const CampaignListener& listener) {
  watch_stop_signals();
  run_campaigns(plans, listener);
  watch_stop_signals_no_more();  // nobody asks for them any more
}

CampaignSummary fly_campaign(const Scenario& scenario, const CampaignOptions& options) {
  watch_stop_signals();
  const PlannedCampaign plan = plan_campaign(scenario, options);
  return run_campaign(scenario, plan.options, plan.fly);
}

int report_errors(const CampaignSummary& summary) {
  if (summary.errors == 0) return kOk;
  std::cerr << count_text(summary.errors, "throw")
            << " had a flight that failed; see \"Errors\" in table.md.";
  const auto first = std::ranges::find_if(
      summary.results, [](const ThrowResult& result) { return result.flown.failed(); });
  if (first != summary.results.end()) {
    std::cerr << " Throw " << first->index << ": " << first->flown.error;
  }
  std::cerr << "\n";
  return kIncomplete;
}

int report_stop(const std::string& flown, const CampaignOptions& options) {
  std::cerr << "Stopped after " << flown << "; the same command with --resume"
            << (options.force ? " in place of --force" : "") << " flies the rest.\n";
  return kIncomplete;
}

int report_stop(const CampaignSummary& summary, const CampaignOptions& options) {
  return report_stop(std::to_string(summary.wanted - summary.missing) + " of " +
                         count_text(summary.wanted, "throw"),
                     options);
}

}  // namespace dodgesim
