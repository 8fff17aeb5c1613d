// dodgesim paper: the experiments of Falanga et al. 2020.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>

#include "sim/base/error.h"
#include "sim/base/shell.h"
#include "sim/campaign/campaign_files.h"
#include "sim/files/text_table.h"
#include "sim/paper/paper_tables.h"
#include "sim/preflight/try_models.h"
#include "tools/commands/campaign_options.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct PaperArguments {
  std::vector<std::string> experiments;
  std::string models_dir;
  CampaignOptions options;
  RepeatOptions repeat;
  std::vector<std::string> set;
};

Scenario scenario_of(const PaperFlight& flight, const std::string& models_dir) {
  return load_scenario(DODGESIM_SCENARIOS_DIR "/paper/" + flight.scenario, models_dir,
                       flight.settings);
}

// More than the experiments' own seeds, so that own + kSeedStep * n is different for each.
constexpr std::uint64_t kSeedStep = 1'000'000;

// Moves the seed: all throws are new, and flights that shared their throws still do.
void add_to_seed(const Setting& seed, const std::string& models_dir, PaperFlight& flight) {
  const std::uint64_t own = scenario_of(flight, models_dir).seed;
  const std::uint64_t most = (std::numeric_limits<std::uint64_t>::max() - own) / kSeedStep;
  flight.settings.push_back(seed);
  const std::uint64_t steps = scenario_of(flight, models_dir).seed;
  if (steps > most) {
    throw ScenarioError("--seed is " + std::to_string(steps) + ", but must be at most " +
                        std::to_string(most) + ".");
  }
  flight.settings.back().value = std::to_string(own + kSeedStep * steps);
}

// The experiments as the command line wants them.
std::vector<PaperExperiment> chosen_experiments(const PaperArguments& arguments) {
  std::vector<Setting> settings = parse_settings("--set", arguments.set), seed;
  append_settings({arguments.repeat.throws, ""}, settings);
  append_settings({"", arguments.repeat.seed}, seed);
  std::vector<PaperExperiment> experiments = experiments_named(arguments.experiments);
  for (PaperExperiment& experiment : experiments) {
    for (PaperFlight& flight : experiment.flights) {
      flight.settings.insert(flight.settings.end(), settings.begin(), settings.end());
      for (const Setting& setting : seed) add_to_seed(setting, arguments.models_dir, flight);
    }
  }
  return experiments;
}

// What decides the tables, without where they go and how fast.
std::string table_command(const PaperArguments& arguments) {
  std::string line = "dodgesim paper";
  for (const std::string& name : arguments.experiments) line += " " + name;
  for (const std::string& set : arguments.set) line += " --set " + shell_quoted(set);
  const auto& [throws, seed] = arguments.repeat;
  if (!throws.empty()) line += " --throws " + throws;
  if (!seed.empty()) line += " --seed " + seed;
  return line;
}

// Tables with flights are not overwritten because their campaigns are not; those that are only
// measured have no campaigns.
void protect_measured(const PaperArguments& arguments,
                      const std::vector<PaperExperiment>& experiments) {
  if (arguments.options.force || arguments.options.resume) return;
  for (const PaperExperiment& experiment : experiments) {
    const auto table = arguments.options.out / (experiment.name + ".md");
    if (experiment.measure == nullptr || !std::filesystem::exists(table)) continue;
    throw ScenarioError(table.string() + " was measured before; choose another directory, or add " +
                        "--force to measure anew.");
  }
}

struct Flown {
  std::size_t campaigns = 0;  // to their end
  int errors = 0;             // throws of which a flight failed
};

Flown fly(const PaperArguments& arguments, const std::vector<PaperFlight>& flights,
          const std::vector<Scenario>& scenarios) {
  std::vector<PlannedCampaign> plans;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    CampaignOptions options = arguments.options;
    options.out = flight_directory(options.out, flights[i]);
    options.truth = flights[i].truth;
    plans.push_back(plan_campaign(scenarios[i], options));
  }
  Flown flown;
  CampaignListener listener;
  listener.begun = [&](std::size_t i) {
    std::cerr << "Flying " << flights[i].name << " (" << i + 1 << " of " << flights.size() << ")\n";
  };
  listener.ended = [&](std::size_t /*i*/, const CampaignSummary& summary) {
    if (summary.complete()) ++flown.campaigns;
    flown.errors += summary.errors;
  };
  fly_campaigns(plans, listener);
  return flown;
}

int paper(const PaperArguments& arguments) {
  expect_no_campaign(arguments.options.out);
  const std::vector<PaperExperiment> experiments = chosen_experiments(arguments);
  const std::vector<PaperFlight> flights = flights_of(experiments);
  std::vector<Scenario> scenarios;
  scenarios.reserve(flights.size());
  for (const PaperFlight& flight : flights) {
    scenarios.push_back(scenario_of(flight, arguments.models_dir));
    if (scenarios.back().stop) {
      throw ScenarioError("The paper's tables need every throw: no key stop.");
    }
    if (!flies_plugin(scenarios.back())) continue;
    throw ScenarioError(
        "pilot is plugin, but the paper's tables are of its pilot, of dodgesim and of oracle.");
  }

  protect_measured(arguments, experiments);
  try_models(scenarios);  // all of them before an hour of flights
  const Flown flown = fly(arguments, flights, scenarios);
  if (flown.campaigns < flights.size()) {
    return report_stop(
        std::to_string(flown.campaigns) + " of " + std::to_string(flights.size()) + " campaigns",
        arguments.options);
  }
  if (std::ranges::any_of(experiments, [](const PaperExperiment& experiment) {
        return experiment.measure != nullptr;
      })) {
    std::cerr << "Timing the stages of the flight core\n";
  }
  std::cout << write_paper_tables(arguments.options.out, experiments,
                                  {arguments.models_dir, DODGESIM_SCENARIOS_DIR},
                                  table_command(arguments));
  if (flown.errors == 0) return kOk;
  std::cerr << count_text(flown.errors, "throw") << " had a flight that failed; see the tables in "
            << (arguments.options.out / "flights").string() << ".\n";
  return kIncomplete;
}

}  // namespace

void add_paper_command(CLI::App& program, const std::string& command_line, int& exit_code) {
  auto arguments = std::make_shared<PaperArguments>();
  arguments->options.command_line = command_line;
  CLI::App* command = program.add_subcommand(
      "paper",
      "Fly the experiments of Falanga et al. 2020, and put the results beside the paper's");
  command
      ->add_option("experiments", arguments->experiments,
                   "Which ones; by default all that take minutes")
      ->type_name("EXPERIMENT");
  add_campaign_options(*command, "paper", arguments->options);
  add_repeat_options(
      *command, arguments->repeat,
      "Repeats of every scenario, in place of its own: for a quick look",
      "Moves the seed of every scenario, by so many millions: for trying something out, as no\n"
      "parameter may be tuned on the throws that are reported");
  add_set_option(*command, arguments->set);
  add_models_option(*command, arguments->models_dir);
  std::string list = "Experiments:\n";
  for (const PaperExperiment& experiment : paper_experiments()) {
    list += "  " + experiment.name + "    " + experiment.title +
            (experiment.only_named ? " (more than an hour; only when it is named)\n" : "\n");
  }
  command->footer(list +
                  "\nWrites to DIR: EXPERIMENT.md and EXPERIMENT.csv with the paper's figures "
                  "beside ours,\nREADME.md, and the campaigns in flights/, which replay, table and "
                  "report can read.\n\n"
                  "Examples:\n"
                  "  dodgesim paper --out out/paper -j 2\n"
                  "  dodgesim paper table2 --out out/table2\n"
                  "  dodgesim paper table2 --out out/dusk --seed 7 --throws 20 --set "
                  "sensors.events.preset=low_light");
  command->callback([arguments, &exit_code] {
    set_default_out("paper", arguments->options);
    exit_code = paper(*arguments);
  });
}

}  // namespace dodgesim
