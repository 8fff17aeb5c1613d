// The experiments of Falanga et al. 2020: what is flown, and what becomes of it.
#pragma once

#include <string>
#include <vector>

#include "sim/campaign/load_campaign.h"
#include "sim/config/scenario_tree.h"

namespace dodgesim {

// A campaign. Experiments that name the same one share its flights.
struct PaperFlight {
  std::string name;               // of its directory
  std::string scenario;           // file in scenarios/paper/
  std::vector<Setting> settings;  // laid over the file

  // What `dodgesim run` needs to fly the same: "scenarios/paper/x.yaml --set throw.size_m=0.1".
  std::string arguments() const;
};

// A word of a shell's command: in quotes unless it is plain.
std::string shell_quoted(const std::string& word);

// The setting "KEY=VALUE".
Setting paper_setting(const std::string& key, const std::string& value);

struct PaperTables {
  std::string markdown;  // ours beside the paper's, and how each word of the protocol was read
  std::string csv;
};

struct PaperExperiment {
  std::string name;   // "table1"
  std::string title;  // one line
  std::vector<PaperFlight> flights;
  // The tables of the flown campaigns, in the order of `flights`; their results have all rows of
  // detections and trajectories. The same tables for the same campaigns.
  PaperTables (*analyse)(const std::vector<LoadedCampaign>& campaigns);
};

// All of them, in the paper's order.
const std::vector<PaperExperiment>& paper_experiments();

PaperExperiment table1_experiment();
PaperExperiment table2_experiment();
PaperExperiment indoor_experiment();
PaperExperiment outdoor_experiment();
PaperExperiment shapes_experiment();

}  // namespace dodgesim
