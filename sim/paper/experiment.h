// The experiments of Falanga et al. 2020: what is flown, and what becomes of it.
#pragma once

#include <string>
#include <vector>

#include "sim/bench/bench.h"
#include "sim/config/scenario_tree.h"
#include "sim/plot/plot.h"
#include "sim/tables/loaded_campaign.h"

namespace dodgesim {

// A campaign. Experiments that name the same one share its flights.
struct PaperFlight {
  std::string name;               // of its directory
  std::string scenario;           // file in scenarios/paper/
  std::vector<Setting> settings;  // laid over the file
  bool truth = false;             // the causes of the events are wanted: ThrowResult::truth_rows

  // What `dodgesim run` needs to fly the same: "scenarios/paper/x.yaml --set throw.size_m=0.1".
  std::string arguments() const;
};

// The setting "KEY=VALUE".
Setting paper_setting(const std::string& key, const std::string& value);

struct PaperPlot {
  std::string name;  // of its file, behind the experiment's: "latency_falanga2020.png"
  Plot plot;
};

struct PaperTables {
  std::string markdown;  // ours beside the paper's, and how each word of the protocol was read
  std::string csv;
  std::vector<PaperPlot> plots = {};  // shown above the tables
};

struct PaperExperiment {
  std::string name;   // "table1"
  std::string title;  // one line
  std::vector<PaperFlight> flights;
  // The tables of the flown campaigns, in the order of `flights`; their results have all rows of
  // detections and trajectories. The same tables for the same campaigns.
  PaperTables (*analyse)(const std::vector<LoadedCampaign>& campaigns);
  // In place of flights and analyse: what is timed on this machine. Its pictures go into the
  // directory of `options.plots_dir`.
  PaperTables (*measure)(const BenchOptions& options) = nullptr;
  bool only_named = false;  // takes so long that "all experiments" leaves it out
};

// A change to a scenario whose throws stay the same.
struct PaperVariant {
  std::string file;  // of its flight, behind a prefix
  std::string name;  // for people
  std::vector<Setting> settings;
};
std::vector<PaperFlight> flights_of(const std::string& prefix, const std::string& scenario,
                                    const std::vector<PaperVariant>& variants);

// Every one: the paper's, the claims, then those that are flown only when they are named.
const std::vector<PaperExperiment>& paper_experiments();

PaperExperiment table1_experiment();
PaperExperiment table2_experiment();
PaperExperiment table3_experiment();
PaperExperiment indoor_experiment();
PaperExperiment outdoor_experiment();
PaperExperiment shapes_experiment();
PaperExperiment more_throws_experiment();
PaperExperiment drift_experiment();
PaperExperiment latency_experiment();
PaperExperiment speed_experiment();
PaperExperiment range_experiment();
PaperExperiment field_experiment();
PaperExperiment physics_experiment();
PaperExperiment threshold_experiment();
PaperExperiment translation_experiment();
PaperExperiment quiet_experiment();

// What table3 makes of the quantities of pilot_cases().
PaperTables table3_of(const std::vector<Measurement>& measured);

}  // namespace dodgesim
