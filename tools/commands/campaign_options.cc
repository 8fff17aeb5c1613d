#include "tools/commands/campaign_options.h"

#include <unistd.h>

#include <csignal>
#include <iostream>
#include <thread>

#include "sim/event_truth.h"
#include "sim/loop.h"
#include "sim/render/osmesa_context.h"
#include "sim/try_models.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

// Set by a signal that asks for the end. A second one ends the program at once.
volatile std::sig_atomic_t stop_signal = 0;

void ask_to_stop(int signal) { stop_signal = signal; }

void watch_signals() {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

ThrowResult fly_with_truth(const Scenario& scenario, int index) {
  EventTruth truth;
  ThrowResult result = fly_throw(scenario, index, &truth);
  result.truth_rows = truth.rows();
  for (EventTruthRow& row : result.truth_rows) row.throw_index = index;
  return result;
}

}  // namespace

void add_campaign_options(CLI::App& command, CampaignOptions& options) {
  options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  constexpr double kTimeLimitS = 600;
  constexpr std::int64_t kMemoryLimitMb = 4096;
  options.limits = {kTimeLimitS, kMemoryLimitMb};
  command.add_option("--out", options.out, "Where the results go; made when missing")
      ->required()
      ->type_name("DIR");
  command.add_option("-j,--jobs", options.jobs, "Worker processes; results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  CLI::Option* force =
      command.add_flag("--force", options.force, "Start anew, whatever results are in DIR");
  command.add_flag("--resume", options.resume, "Fly only the throws that DIR has no results of")
      ->excludes(force);
  command
      .add_option("--time-limit", options.limits.wall_s,
                  "Seconds of computing after which a throw is given up; 0: never")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command
      .add_option("--memory-limit", options.limits.memory_mb,
                  "Address space of a worker [MB]; a throw that needs more fails; 0: no limit")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
}

CampaignSummary fly_campaign(const Scenario& scenario, CampaignOptions options) {
  try_models(scenario);
  options.models = digest_of_models(scenario);
  watch_signals();
  options.stop = [] { return stop_signal != 0; };
  options.show_progress = ::isatty(STDERR_FILENO) == 1;
  options.gl_renderer = renderer_name;
  const bool truth = options.truth;
  return run_campaign(scenario, options, [&scenario, truth](int index) {
    return truth ? fly_with_truth(scenario, index) : fly_throw(scenario, index);
  });
}

int report_stop(const CampaignSummary& summary) {
  std::cerr << "Stopped after " << summary.wanted - summary.missing << " of "
            << count_of_throws(summary.wanted) << "; the same command with --resume flies the "
            << "rest.\n";
  return kIncomplete;
}

}  // namespace dodgesim
