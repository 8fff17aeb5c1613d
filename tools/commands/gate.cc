// dodgesim gate: flies a baseline's throws and fails when they went worse.
#include "sim/gate/gate.h"
#include "sim/campaign/campaign_files.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/config/expand.h"
#include "sim/config/scenario_changes.h"
#include "sim/files/csv.h"
#include "sim/files/output_file.h"
#include "sim/files/text_table.h"
#include "sim/outcome/blank_result.h"
#include "sim/preflight/try_models.h"
#include "sim/preflight/try_plugin.h"
#include "sim/tables/report.h"
#include "tools/commands/campaign_options.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

struct GateArguments {
  std::string scenario;
  std::string models_dir;
  std::string plugin;
  std::vector<std::string> set;
  fs::path baseline;
  fs::path junit;
  bool update = false;
  std::optional<double> margin, confidence;
  std::optional<std::string> must_equal;
  CampaignOptions options;
};

GateRules rules_of(const GateArguments& arguments) {
  GateRules rules = rules_or_default(arguments.baseline);
  rules.margin = arguments.margin.value_or(rules.margin);
  rules.confidence = arguments.confidence.value_or(rules.confidence);
  rules.must_equal = arguments.must_equal.value_or(rules.must_equal);
  return rules;
}

// The tables of a campaign that has not begun.
CampaignTables blank_tables(const Scenario& scenario) {
  std::string throws = csv_header(blank_result(case_of(scenario, 0)));
  std::string objects = csv_header<ObjectRow>();
  for (int i = 0; i < throw_count(scenario); ++i) {
    const ThrowResult blank = blank_result(case_of(scenario, i));
    throws += csv_row(blank);
    for (const ObjectRow& row : blank.object_rows) objects += csv_row(row);
  }
  return {CsvTable(throws, "the scenario's throws"), CsvTable(objects, "the scenario's objects"),
          scenario.seed};
}

// Other throws cannot be compared one by one: found out before hours of flying.
void expect_same_throws(const Scenario& scenario, const Baseline& baseline, const fs::path& where) {
  const auto drawn = outcomes(blank_tables(scenario));
  const auto before = outcomes(baseline.tables);
  const std::string now = to_yaml(scenario);
  const bool same_scenario = now == baseline.scenario;
  const auto refuse = [&](const std::string& what) {
    const std::string why = same_scenario
                                ? "the scenario is the same, but this version throws otherwise"
                                : scenario_difference(now, baseline.scenario);
    throw ScenarioError(what + " (" + why +
                        "); to make a new baseline of this scenario, add --update.");
  };
  if (drawn.size() != before.size() && same_scenario) {
    throw IoError((where / kThrowsFile).string() + " has " + std::to_string(before.size()) +
                  " of the " + std::to_string(drawn.size()) + " throws of its scenario; --update " +
                  "replaces it.");
  }
  if (drawn.size() != before.size()) {
    refuse("The scenario has " + std::to_string(drawn.size()) + " throws, " + where.string() +
           " has " + std::to_string(before.size()));
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (same_throw(drawn[i], before[i]) && drawn[i].cell == before[i].cell) continue;
    refuse("Throw " + std::to_string(i) + " is another one than in " + where.string());
  }
}

void list_changes(const std::string& heading, const std::vector<ChangedThrow>& changes,
                  const Scenario& scenario, const std::string& replay, std::ostream& text) {
  if (changes.empty()) return;
  // Of a quiet flight there is no picture.
  const bool thrown = scenario.anyone_throws();
  const std::string show = thrown ? " --picture throw" : " --video flight";
  const std::string ending = thrown ? ".png" : ".mp4";
  constexpr std::size_t kMost = 10;
  text << heading << ":\n";
  for (std::size_t i = 0; i < std::min(changes.size(), kMost); ++i) {
    const ChangedThrow& change = changes[i];
    text << "  throw " << change.number << " (" << change.label << "): " << change.before
         << ", now " << change.after << "\n    " << replay << change.number << show << change.number
         << ending << "\n";
  }
  if (changes.size() <= kMost) return;
  text << "  and throws";
  for (std::size_t i = kMost; i < changes.size(); ++i) text << " " << changes[i].number;
  text << "\n";
}

std::string verdict_text(const GateArguments& arguments, const Scenario& scenario,
                         const Baseline& baseline, const GateVerdict& verdict) {
  std::ostringstream text;
  const auto changes = scenario_changes(baseline.scenario, to_yaml(scenario));
  if (!changes.empty()) text << "The scenario is not the baseline's:\n";
  for (const ScenarioChange& change : changes) {
    text << "  " << change.key << " was " << change.before << ", is " << change.after << "\n";
  }
  text << comparison_text(verdict.comparison,
                          arguments.baseline.string() + " (commit " + baseline.commit + ")",
                          arguments.options.out.string());
  const std::string replay = replay_line(arguments.options.out.string(), scenario);
  list_changes("Lost", verdict.comparison.lost, scenario, replay, text);
  list_changes("Gained", verdict.comparison.gained, scenario, replay, text);
  for (const GateCheck& check : verdict.checks) {
    const char* result = check.result == GateCheck::Result::kPassed   ? "passed"
                         : check.result == GateCheck::Result::kFailed ? "FAILED"
                                                                      : "left out";
    text << result << ": " << check.name << (check.reason.empty() ? "" : ": ") << check.reason
         << "\n";
  }
  return text.str();
}

int update(const GateArguments& arguments, const GateRules& rules, const CampaignSummary& summary) {
  std::cout << summary.table;
  if (summary.errors > 0) {
    std::cerr << count_text(summary.errors, "throw")
              << " had a flight that failed: no baseline is made.\n";
    return kIncomplete;
  }
  write_baseline(arguments.baseline, arguments.options.out, rules);
  std::cout << "Baseline: " << arguments.baseline.string() << " (margin " << rules.margin
            << ", confidence " << rules.confidence << ", must equal: " << rules.must_equal << ")\n";
  return kOk;
}

void expect_gateable(const Scenario& scenario, const GateArguments& arguments) {
  std::error_code error;
  if (fs::equivalent(arguments.baseline, arguments.options.out, error)) {
    throw ScenarioError("--baseline and --out are the same directory, " +
                        arguments.options.out.string() + ".");
  }
  if (sweep_count(scenario) > 1) {
    throw ScenarioError(arguments.scenario +
                        ": a gate's scenario has no sweep, of which every value flies the same "
                        "throws.");
  }
  if (scenario.stop) {
    throw ScenarioError(arguments.scenario +
                        ": a gate's scenario has no key stop, as every throw of the baseline must "
                        "be flown; --set 'stop=~' leaves it out.");
  }
}

// Checked before hours of flying.
void expect_writable(const std::string& option, const fs::path& value, const fs::path& where) {
  fs::path there = fs::absolute(where);
  while (!fs::exists(there)) there = there.parent_path();
  std::string reason = "is not a directory";
  if (fs::is_directory(there)) {
    if (::access(there.c_str(), W_OK | X_OK) == 0) return;
    reason = std::strerror(errno);
  }
  throw IoError(option + " " + value.string() + " cannot be written: " + there.string() + ": " +
                reason + ".");
}

// Nothing if there is none yet, or a broken one that is to be replaced.
std::optional<Baseline> find_baseline(const GateArguments& arguments) {
  const fs::path& where = arguments.baseline;
  if (fs::exists(where) && !fs::is_directory(where)) {
    throw ScenarioError("--baseline " + where.string() + " is not a directory.");
  }
  if (arguments.update) expect_writable("--baseline", where, where);
  if (!holds_baseline_files(where)) {
    if (arguments.update) return std::nullopt;
    throw ScenarioError("There is no baseline in " + where.string() + "; add --update to make it.");
  }
  try {
    return read_baseline(where);
  } catch (const IoError& error) {
    if (!is_marked_as_baseline(where)) {
      throw IoError(where.string() +
                    " is not empty, but no baseline: it has no manifest.json with \"gate\". Choose "
                    "another directory, or remove what is there.");
    }
    if (!arguments.update) {
      throw IoError(std::string(error.what()) + " To make the baseline anew, add --update.");
    }
    std::cerr << where.string() << " is broken and will be replaced: " << error.what() << "\n";
    return std::nullopt;
  }
}

// Only an earlier report may be replaced. `shown` is the path as the user knows it.
void expect_report_or_nothing(const fs::path& junit, const std::string& shown) {
  if (!fs::exists(junit)) return;
  if (fs::is_regular_file(junit)) {
    const std::string text = read_file(junit);
    if (text.empty() || is_junit(text)) return;
  }
  throw IoError(shown + " exists, and is no JUnit report to be replaced.");
}

fs::path junit_path(const GateArguments& arguments) {
  return arguments.junit.empty() ? arguments.options.out / "junit.xml" : arguments.junit;
}

void expect_place_for_report(const GateArguments& arguments) {
  const fs::path& junit = arguments.junit;
  const fs::path path = junit_path(arguments);
  if (junit.empty()) return expect_report_or_nothing(path, path.string());
  const fs::path folder = fs::absolute(junit).parent_path();
  expect_writable("--junit", junit, folder);
  if (!fs::is_directory(folder)) {
    throw IoError("--junit " + junit.string() + " cannot be written: there is no such folder.");
  }
  expect_report_or_nothing(path, "--junit " + path.string());
}

int gate(const GateArguments& arguments) {
  const Scenario scenario = with_plugin(load_scenario(arguments.scenario, arguments.models_dir,
                                                      parse_settings("--set", arguments.set)),
                                        arguments.plugin);
  expect_gateable(scenario, arguments);
  expect_place_for_report(arguments);
  // A gate that ends without a verdict must not leave an earlier one behind.
  std::error_code not_there;
  fs::remove(junit_path(arguments), not_there);
  const std::optional<Baseline> baseline = find_baseline(arguments);
  const GateRules rules = rules_of(arguments);
  if (!arguments.update) expect_same_throws(scenario, *baseline, arguments.baseline);

  try_models({scenario});
  try_plugin(scenario);
  const CampaignSummary summary = fly_campaign(scenario, arguments.options);
  if (!summary.complete()) return report_stop(summary, arguments.options);
  if (arguments.update) return update(arguments, rules, summary);

  const fs::path& out = arguments.options.out;
  const GateVerdict verdict = judge(*baseline, read_tables(out), machine_kind(out), rules);
  const std::string text = verdict_text(arguments, scenario, *baseline, verdict);
  std::cout << text << std::flush;
  write_file(junit_path(arguments), junit_xml(verdict, scenario.name, text));
  return verdict.passed() ? kOk : kBelowBar;
}

void add_options(CLI::App& command, GateArguments& arguments) {
  command.add_option("scenario", arguments.scenario, "The scenario's YAML file")
      ->required()
      ->type_name("SCENARIO.yaml");
  command.add_option("--baseline", arguments.baseline, "What to compare with")
      ->required()
      ->type_name("DIR");
  add_campaign_options(command, "SCENARIO", arguments.options);
  add_set_option(command, arguments.set);
  command.add_flag("--update", arguments.update,
                   "Make this campaign the baseline, with the rules below");
  command
      .add_option("--margin", arguments.margin,
                  "The success rate may fall by so much, in place of the baseline's (0.05)")
      ->check(number_between(0, 0.99));
  command
      .add_option("--confidence", arguments.confidence,
                  "How sure the fall must be, in place of the baseline's (0.95)")
      ->check(number_between(0.5, 0.9999));
  command
      .add_option("--must-equal", arguments.must_equal,
                  "What may not change by a byte on machines of one kind: nothing, physics (the\n"
                  "throws, and where they go when nobody dodges) or all; in place of the\n"
                  "baseline's (physics)")
      ->check(CLI::IsMember({"nothing", "physics", "all"}));
  command
      .add_option("--junit", arguments.junit,
                  "The verdict as JUnit XML, in place of an earlier one [DIR/junit.xml]")
      ->type_name("FILE");
  add_models_option(command, arguments.models_dir);
  add_plugin_option(command, arguments.plugin);
}

}  // namespace

void add_gate_command(CLI::App& program, const std::string& command_line, int& exit_code) {
  auto arguments = std::make_shared<GateArguments>();
  arguments->options.command_line = command_line;
  CLI::App* command = program.add_subcommand(
      "gate", "Fly the throws of a baseline again, and fail if they went worse");
  add_options(*command, *arguments);
  command->footer(
      "Compares throw by throw. Exit code 1: the success rate fell by more than the margin with\n"
      "the confidence, or the throws are too few ever to show that and no bytes are compared; a\n"
      "throw could not be flown; or, on a machine of the baseline's kind, one would have hit in\n"
      "only one of the two, or bytes changed that must not. Prints the throws that\n"
      "changed, and how to look at them. The throws are the baseline's: other repeats or another\n"
      "seed (--set seed=8) make another baseline, with --update.\n\n"
      "Examples:\n"
      "  dodgesim gate s.yaml --baseline baselines/s --out out/s --update      once\n"
      "  dodgesim gate s.yaml --baseline baselines/s --out out/s --force       after each change");
  command->callback([arguments, &exit_code] {
    set_default_out(fs::path(arguments->scenario).stem(), arguments->options);
    exit_code = gate(*arguments);
  });
}

}  // namespace dodgesim
