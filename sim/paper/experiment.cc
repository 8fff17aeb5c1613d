#include "sim/paper/experiment.h"

namespace dodgesim {

std::string PaperFlight::arguments() const {
  std::string text = "scenarios/paper/" + scenario;
  for (const Setting& setting : settings) text += " --set " + setting.key + "=" + setting.value;
  return text;
}

Setting paper_setting(const std::string& key, const std::string& value) {
  return {key, value, "--set " + key + "=" + value};
}

const std::vector<PaperExperiment>& paper_experiments() {
  static const std::vector<PaperExperiment> all = {table1_experiment(), table2_experiment()};
  return all;
}

}  // namespace dodgesim
