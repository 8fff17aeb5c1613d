#include "sim/paper/experiment.h"

#include <algorithm>
#include <cctype>

namespace dodgesim {

std::string shell_quoted(const std::string& word) {
  const bool plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '=' || c == '-';
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string PaperFlight::arguments() const {
  std::string text = "scenarios/paper/" + scenario;
  for (const Setting& setting : settings) {
    text += " --set " + shell_quoted(setting.key + "=" + setting.value);
  }
  return truth ? text + " --truth" : text;
}

Setting paper_setting(const std::string& key, const std::string& value) {
  return {key, value, "--set " + key + "=" + value};
}

std::vector<PaperFlight> flights_of(const std::string& prefix, const std::string& scenario,
                                    const std::vector<PaperVariant>& variants) {
  std::vector<PaperFlight> flights;
  for (const PaperVariant& variant : variants) {
    flights.push_back({prefix + variant.file, scenario, variant.settings});
  }
  return flights;
}

const std::vector<PaperExperiment>& paper_experiments() {
  static const std::vector<PaperExperiment> all = {
      table1_experiment(),    table2_experiment(),      indoor_experiment(),  outdoor_experiment(),
      shapes_experiment(),    more_throws_experiment(), drift_experiment(),   latency_experiment(),
      speed_experiment(),     range_experiment(),       physics_experiment(), field_experiment(),
      threshold_experiment(), translation_experiment()};
  return all;
}

}  // namespace dodgesim
