// dodgesim compare: two campaigns, or the values of a sweep, side by side.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/input_file.h"
#include "sim/base/joined.h"
#include "sim/campaign/campaign_files.h"
#include "sim/config/expand.h"
#include "sim/config/scenario_changes.h"
#include "sim/files/text_table.h"
#include "sim/gate/comparison.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct CompareArguments {
  std::filesystem::path first;
  std::filesystem::path second;  // empty: the first one's sweep values are compared
  int against = 0;               // this sweep value
};

void print_changes(const std::string& heading, const std::vector<ChangedThrow>& changes) {
  if (changes.empty()) return;
  std::cout << heading << ":\n";
  for (const ChangedThrow& change : changes) {
    std::cout << "  throw " << change.number;
    if (change.number_after != change.number) std::cout << ", then " << change.number_after;
    std::cout << " (" << change.label << "): " << change.before << ", then " << change.after
              << "\n";
  }
}

// Whether the scenario, as written into the directory, may end by what it finds.
bool has_stop(const std::filesystem::path& directory) {
  std::ifstream scenario(directory / kScenarioFile);
  for (std::string line; std::getline(scenario, line);) {
    if (line.starts_with("stop:")) return true;
  }
  return false;
}

// What was changed from one campaign to the other, if both have their scenarios. First what stands
// at the top, such as the pilot, on which much of the rest may depend.
std::vector<ScenarioChange> changes_between(const std::filesystem::path& first,
                                            const std::filesystem::path& second) {
  if (!std::filesystem::exists(first / kScenarioFile) ||
      !std::filesystem::exists(second / kScenarioFile)) {
    return {};
  }
  std::vector<ScenarioChange> changes =
      scenario_changes(read_file(first / kScenarioFile), read_file(second / kScenarioFile));
  std::stable_partition(changes.begin(), changes.end(), [](const ScenarioChange& change) {
    return change.key.find('.') == std::string::npos;
  });
  return changes;
}

void print(const std::vector<ScenarioChange>& changes) {
  constexpr std::size_t kMost = 10;
  if (changes.empty()) return;
  std::cout << "The scenarios differ:\n";
  for (std::size_t i = 0; i < std::min(kMost, changes.size()); ++i) {
    const ScenarioChange& change = changes[i];
    std::cout << "  " << change.key << ": " << change.before << ", then " << change.after << "\n";
  }
  if (changes.size() > kMost) {
    std::cout << "  and "
              << count_text(static_cast<std::int64_t>(changes.size() - kMost), "more key") << "\n";
  }
}

// Whether the change says by itself that another model flew.
bool names_a_model(const ScenarioChange& change) {
  return change.key == "room" || change.key == "vehicle" || change.key.ends_with("object");
}

// Outcomes by the number of their sweep value: of different values they are never pooled.
std::map<int, std::vector<ThrowOutcome>> parts_of(const std::filesystem::path& directory,
                                                  const CampaignTables& tables) {
  if (tables.throws.rows() == 0) {
    throw MissingThrows(directory.string() + " has no throw, so there is nothing to compare.");
  }
  if (tables.planned && tables.throws.rows() < *tables.planned) {
    std::cerr << directory.string() << " has " << tables.throws.rows() << " of the "
              << *tables.planned << " throws of its scenario.\n";
    if (has_stop(directory)) {
      std::cerr << "Its own rate ended it (stop); p and intervals take its length for planned.\n";
    }
  }
  std::vector<ThrowOutcome> all = outcomes(tables);
  const auto of_nobody = std::ranges::count_if(all, &ThrowOutcome::nobody_could_fly);
  if (of_nobody > 0) {
    std::cerr << "In " << directory.string() << " " << count_text(of_nobody, "throw")
              << " could not be flown, whoever the pilot: left out.\n";
  }
  const auto failed = std::ranges::count_if(
      all, [](const ThrowOutcome& o) { return o.failed && !o.nobody_could_fly; });
  if (failed > 0) {
    std::cerr << "In " << directory.string() << " " << count_text(failed, "throw")
              << " had a flight that failed: not dodged, if compared.\n";
  }
  std::map<int, std::vector<ThrowOutcome>> parts;
  for (ThrowOutcome& outcome : all) {
    const int sweep = outcome.sweep;
    parts[sweep].push_back(std::move(outcome));
  }
  return parts;
}

// Whether nobody throws.
bool is_quiet(const std::map<int, std::vector<ThrowOutcome>>& parts) {
  return std::ranges::all_of(parts, [](const auto& part) {
    return std::ranges::all_of(part.second,
                               [](const ThrowOutcome& outcome) { return outcome.draw.empty(); });
  });
}

// "3 sweep values (number 0, 1, 3)"
std::string sweep_text(const std::map<int, std::vector<ThrowOutcome>>& parts) {
  if (parts.size() == 1 && parts.contains(0)) return "no sweep, or only its first value";
  const auto count = static_cast<std::int64_t>(parts.size());
  return count_text(count, "sweep value") + " (number " +
         joined(parts, [](const auto& part) { return std::to_string(part.first); }) + ")";
}

// "Sweep value 1 (delays.compute_us 60000)": with the keys that are the same for all of its throws.
std::string heading(int sweep, const std::vector<ThrowOutcome>& outcomes) {
  std::vector<AxisValue> common;
  for (const AxisValue& setting : outcomes.front().settings) {
    const bool everywhere = std::ranges::all_of(outcomes, [&](const ThrowOutcome& outcome) {
      return std::ranges::count(outcome.settings, setting) == 1;
    });
    if (everywhere) common.push_back(setting);
  }
  return "Sweep value " + std::to_string(sweep) +
         (common.empty() ? "" : " (" + label(common) + ")");
}

// Two parts side by side. Whether there is anything to test.
bool print_comparison(const std::vector<ThrowOutcome>& first,
                      const std::vector<ThrowOutcome>& second, const std::string& first_name,
                      const std::string& second_name, bool other_models = false) {
  Comparison comparison = compare(first, second);
  if (other_models) comparison.differing.push_back("a model");
  if (!comparison.paired) expect_same_cells(first, second, first_name, second_name);
  std::cout << comparison_text(comparison, first_name, second_name);
  print_changes("Lost", comparison.lost);
  print_changes("Gained", comparison.gained);
  return comparison.has_rates();
}

// Each p is right by itself; the smallest of many is small by chance (Bonferroni's bound).
void print_number_of_tests(std::size_t tests) {
  constexpr double kLevel = 0.05;
  if (tests < 2) return;
  std::cout << formatted(
      "\nThese are %zu tests: where nothing differs, the smallest p is below %.2g (%g / %zu) in at "
      "most\n5 %% of such comparisons, but below %g more often.\n",
      tests, kLevel / static_cast<double>(tests), kLevel, tests, kLevel);
}

int compare_campaigns(const CompareArguments& arguments) {
  const CampaignTables first_tables = read_tables(arguments.first);
  const CampaignTables second_tables = read_tables(arguments.second);
  const auto first = parts_of(arguments.first, first_tables);
  const auto second = parts_of(arguments.second, second_tables);
  if (is_quiet(first) != is_quiet(second)) {
    throw ScenarioError("In " + (is_quiet(first) ? arguments.first : arguments.second).string() +
                        " nobody throws, in " +
                        (is_quiet(first) ? arguments.second : arguments.first).string() +
                        " somebody does: not to evade and to dodge cannot be compared.");
  }
  if (!std::equal(first.begin(), first.end(), second.begin(), second.end(),
                  [](const auto& a, const auto& b) { return a.first == b.first; })) {
    throw ScenarioError(arguments.first.string() + " has " + sweep_text(first) + "; " +
                        arguments.second.string() + " has " + sweep_text(second) +
                        ". Campaigns can be compared if they have the same sweep.");
  }
  for (const auto& [sweep, outcomes] : first) {
    expect_same_settings(outcomes, second.at(sweep), arguments.first.string(),
                         arguments.second.string());
  }
  const std::vector<ScenarioChange> changes = changes_between(arguments.first, arguments.second);
  print(changes);
  const bool other_models = !first_tables.models.empty() && !second_tables.models.empty() &&
                            first_tables.models != second_tables.models &&
                            !std::ranges::any_of(changes, names_a_model);
  if (other_models) std::cout << "The models differ (room, vehicle or objects).\n";
  std::size_t tests = 0;
  for (const auto& [sweep, outcomes] : first) {
    if (first.size() > 1) std::cout << (sweep > 0 ? "\n" : "") << heading(sweep, outcomes) << ":\n";
    if (print_comparison(outcomes, second.at(sweep), arguments.first.string(),
                         arguments.second.string(), other_models)) {
      ++tests;
    }
  }
  print_number_of_tests(tests);
  return kOk;
}

// Each value of a campaign's sweep against one of them: they fly the same throws.
int compare_sweep(const CompareArguments& arguments) {
  const auto parts = parts_of(arguments.first, read_tables(arguments.first));
  if (parts.size() < 2) {
    throw ScenarioError(arguments.first.string() + " has " + sweep_text(parts) +
                        ": name a second campaign to compare it with.");
  }
  if (!parts.contains(arguments.against)) {
    throw ScenarioError("--against " + std::to_string(arguments.against) + ": " +
                        arguments.first.string() + " has " + sweep_text(parts) + ".");
  }
  const std::vector<ThrowOutcome>& reference = parts.at(arguments.against);
  const std::string reference_name = heading(arguments.against, reference);
  const char* between = "";
  std::size_t tests = 0;
  for (auto [sweep, others] : parts) {
    if (sweep == arguments.against) continue;
    const std::string name = heading(sweep, others);
    // Pairs have one number within one sweep value.
    for (ThrowOutcome& outcome : others) outcome.sweep = arguments.against;
    std::cout << std::exchange(between, "\n");
    if (print_comparison(reference, others, reference_name, name)) ++tests;
  }
  print_number_of_tests(tests);
  return kOk;
}

}  // namespace

void add_compare_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = program.add_subcommand(
      "compare", "Compare the success rates of two campaigns, or of the values of a sweep");
  command->add_option("first", arguments->first, "What run --out wrote")
      ->required()
      ->type_name("DIR1");
  CLI::Option* second = command->add_option(
      "second", arguments->second,
      "What another run --out wrote; without it the values of DIR1's sweep are\ncompared");
  second->type_name("DIR2");
  command
      ->add_option("--against", arguments->against,
                   "Number of the sweep value that the others are compared with")
      ->type_name("INT")
      ->capture_default_str()
      ->excludes(second);
  command->footer(
      "Success is to dodge a throw that would have hit or, where nobody throws, neither to evade "
      "nor\n"
      "to land or crash.\n"
      "Campaigns of one seed are compared throw by throw (McNemar's exact test), also where a key "
      "of\n"
      "throw differs: the random numbers are the same. Campaigns of other seeds and of the same\n"
      "grid and sweep are independent samples (Boschloo's exact test).\n"
      "Intervals are of 95 %, and approximate: where few outcomes differ, 0 may lie beside one "
      "though\n"
      "p is above 0.05; then p decides.\n\n"
      "Example:\n"
      "  dodgesim run s.yaml --out paper\n"
      "  dodgesim run s.yaml --out told --set pilot=oracle\n"
      "  dodgesim compare paper told\n"
      "  dodgesim sweep s.yaml --out late --over delays.compute_us=3500,30000,60000\n"
      "  dodgesim compare late");
  command->callback([arguments, &exit_code] {
    exit_code =
        arguments->second.empty() ? compare_sweep(*arguments) : compare_campaigns(*arguments);
  });
}

}  // namespace dodgesim
