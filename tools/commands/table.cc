// dodgesim table: the statistics of a campaign, by whatever was varied, in several formats.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/campaign/campaign_files.h"
#include "sim/campaign/load_campaign.h"
#include "sim/files/output_file.h"
#include "sim/tables/statistics_table.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct TableArguments {
  std::string directory;
  std::string format = "md";
  std::vector<std::string> by;
  std::string out;  // empty: standard output
};

std::string formatted(const StatisticsTable& table, const std::string& format) {
  if (format == "csv") return to_csv(table);
  if (format == "json") return to_json(table);
  if (format == "latex") return to_latex(table);
  return to_markdown(table);
}

// So that a slip of the keyboard overwrites no scenario.
void expect_ending(const TableArguments& arguments) {
  const std::string ending = arguments.format == "latex" ? ".tex" : "." + arguments.format;
  if (std::filesystem::path(arguments.out).extension() == ending) return;
  throw ScenarioError("--out " + arguments.out + " must end in " + ending + ", as --format is " +
                      arguments.format + ".");
}

void expect_keys_once(const std::vector<std::string>& keys) {
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    if (std::find(keys.begin(), key, *key) == key) continue;
    throw ScenarioError("--by names " + *key + " twice.");
  }
}

int table(const TableArguments& arguments) {
  if (!arguments.out.empty() && belongs_to_campaign(arguments.out)) {
    throw ScenarioError("--out " + arguments.out + " would overwrite a file of a campaign.");
  }
  if (!arguments.out.empty()) expect_ending(arguments);
  expect_keys_once(arguments.by);
  const LoadedCampaign campaign = load_campaign(arguments.directory);
  const std::vector<Part> parts = parts_of(campaign);
  std::vector<Axis> axes = arguments.by.empty() ? grid_axes(campaign.results) : std::vector<Axis>();
  std::vector<std::string> keys = arguments.by;
  if (keys.empty() && axes.empty()) keys = {"size_m", "distance_m"};
  for (const std::string& key : keys) {
    // What is swept stands apart in any case.
    const std::vector<AxisValue>& swept = parts.front().values;
    if (contains(swept, key, &AxisValue::key)) continue;
    axes.emplace_back(key, campaign.results);
  }
  const std::string text = formatted(group_by(parts, axes), arguments.format);
  if (arguments.out.empty()) {
    std::cout << text;
  } else {
    write_file(arguments.out, text);
  }
  return completeness(arguments.directory, campaign);
}

}  // namespace

void add_table_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<TableArguments>();
  CLI::App* command =
      program.add_subcommand("table", "Statistics of a campaign's throws, in groups");
  command->add_option("directory", arguments->directory, "What `dodgesim run --out DIR` wrote")
      ->required()
      ->type_name("DIR");
  command->add_option("--format", arguments->format, "md, csv, json or latex (needs booktabs)")
      ->check(CLI::IsMember({"md", "csv", "json", "latex"}))
      ->capture_default_str();
  command
      ->add_option("--by", arguments->by,
                   "What tells the groups apart, with commas: size_m, distance_m, speed_mps,\n"
                   "bearing_deg, launch_height_m, object, or a key of the scenario's grid (when\n"
                   "not given: all of those, or size_m and distance_m without a grid); the values\n"
                   "of a sweep always stand apart")
      ->delimiter(',')
      ->transform([](const std::string& key) {
        return key.substr(std::min(key.find_first_not_of(' '), key.size()));  // behind a comma
      })
      ->type_name("KEYS");
  command->add_option("--out", arguments->out, "Where it goes, instead of the terminal")
      ->type_name("FILE");
  command->footer(
      "Rates (dodged of those that would have hit, hit or crashed, detected of those in view, "
      "false\n"
      "alarms) stand with counts and 95 % intervals; detection distance, time to contact, "
      "latencies\n"
      "and clearance as quantiles. csv and json have all of it, the others the most important.\n\n"
      "Examples:\n"
      "  dodgesim table out/demo --by speed_mps\n"
      "  dodgesim table out/demo --by object,size_m --format latex --out table.tex");
  command->callback([arguments, &exit_code] { exit_code = table(*arguments); });
}

}  // namespace dodgesim
