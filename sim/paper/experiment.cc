#include "sim/paper/experiment.h"

#include "sim/base/shell.h"

namespace dodgesim {

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
  flights.reserve(variants.size());
  for (const PaperVariant& variant : variants) {
    flights.push_back({prefix + variant.file, scenario, variant.settings});
  }
  return flights;
}

const std::vector<PaperExperiment>& paper_experiments() {
  static const std::vector<PaperExperiment> all = {
      table1_experiment(),  table2_experiment(),    table3_experiment(),      indoor_experiment(),
      outdoor_experiment(), shapes_experiment(),    more_throws_experiment(), drift_experiment(),
      latency_experiment(), speed_experiment(),     range_experiment(),       physics_experiment(),
      field_experiment(),   threshold_experiment(), translation_experiment(), quiet_experiment()};
  return all;
}

}  // namespace dodgesim
