#include "tools/commands/command.h"

#include <charconv>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "sim/base/error.h"
#include "sim/campaign/journal.h"
#include "sim/files/staged_file.h"
#include "sim/files/text_table.h"
#include "sim/tables/loaded_campaign.h"

namespace dodgesim {

namespace {

// Whether all of a text is a number between two others.
template <class T>
bool is_between(const std::string& text, T least, T most) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end && value >= least && value <= most;
}

template <class T>
CLI::Validator between(const std::string& kind, T least, T most) {
  std::ostringstream range;
  range.precision(15);
  range << kind << " between " << least << " and " << most;
  return {[=, allowed = range.str()](const std::string& text) -> std::string {
            std::string sentence = text + " was given, but must be " + allowed;
            if (!is_between(text, least, most)) return sentence;
            // CLI11 would take it as octal.
            const bool zeros = std::is_integral_v<T> && text.size() > 1 && text.front() == '0';
            return zeros ? sentence + " without leading zeros" : "";
          },
          ""};
}

}  // namespace

CLI::Validator number_between(double least, double most) {
  return between("a number", least, most);
}

CLI::Validator whole_number_between(std::uint64_t least, std::uint64_t most) {
  return between("a whole number", least, most);
}

CLI::Validator file_ending(const std::string& extension) {
  return {[extension](const std::string& text) {
            return std::filesystem::path(text).extension() == extension
                       ? std::string()
                       : text + " must be the name of a file that ends in " + extension;
          },
          ""};
}

void add_models_option(CLI::App& command, std::string& models_dir) {
  models_dir = DODGESIM_MODELS_DIR;
  command.add_option("--models", models_dir, "Folder of the rooms, vehicles and objects")
      ->envname("DODGESIM_MODELS")
      ->capture_default_str()
      ->type_name("DIR");
}

void add_plugin_option(CLI::App& command, std::string& file) {
  command
      .add_option("--plugin", file,
                  "Your pilot's shared library (dodge/plugin.h), for pilot: plugin")
      ->type_name("FILE.so");
}

Scenario with_plugin(Scenario scenario, const std::string& file) {
  if (!file.empty()) scenario.plugin = read_plugin(file);
  return scenario;
}

void add_set_option(CLI::App& command, std::vector<std::string>& set) {
  command
      .add_option("--set", set,
                  "Set a key of the scenario, whatever its file says; the value is YAML;\n"
                  "repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

std::vector<Setting> parse_settings(const std::string& option,
                                    const std::vector<std::string>& texts) {
  std::vector<Setting> settings;
  for (const std::string& text : texts) {
    const std::string shown = option + " " + text;
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      throw ScenarioError(shown + ": This must be KEY=VALUE, such as throw.speed_mps=6.");
    }
    if (text.find_first_not_of(" \t\r\n", equals + 1) == std::string::npos) {
      throw ScenarioError(shown +
                          ": A value is needed behind =, such as throw.speed_mps=6; 'throw=~' "
                          "takes away a key that the file has.");
    }
    settings.push_back({text.substr(0, equals), text.substr(equals + 1), shown});
  }
  return settings;
}

void refuse_to_overwrite(const std::vector<std::string>& inputs, const std::string& file,
                         const std::string& option) {
  std::error_code ignored;
  const std::filesystem::path partial = StagedFile::partial_name(StagedFile::target(file));
  for (const std::string& input : inputs) {
    if (std::filesystem::equivalent(file, input, ignored) ||
        std::filesystem::equivalent(partial, input, ignored)) {
      throw ScenarioError(option + " would overwrite the input " + input + ".");
    }
  }
}

int completeness(const std::string& directory, const LoadedCampaign& campaign) {
  const std::string all = count_text(throw_count(campaign.scenario), "throw");
  if (!campaign.complete()) {
    std::cerr << directory << " has " << campaign.results.size() << " of " << all << " only"
              << (campaign.damaged ? "; " + damage_text(directory) : "") << ".\n";
    return kIncomplete;
  }
  if (campaign.ended_early()) {
    std::cerr << directory << " was ended by stop after " << campaign.wanted() << " of at most "
              << all << ".\n";
  }
  return kOk;
}

std::string truth_text(const EventTruthSums& sums) {
  const auto share = [](std::optional<double> value) {
    return value ? fixed_text(*value, 3) : std::string("undefined");
  };
  const auto line = [&](const EventTruthCounts& counts) {
    return "precision " + share(counts.precision()) + " of " + std::to_string(counts.found_events) +
           " taken for an obstacle's, recall " + share(counts.recall()) + " of " +
           std::to_string(counts.object_events) + " that an object made";
  };
  return "Events before the vehicle evades: " + line(sums.before) +
         "\nEvents from then on: " + line(sums.after) +
         "\n(An event counts once for each of the pilot's windows that it is in.)";
}

}  // namespace dodgesim
