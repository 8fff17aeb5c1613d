// Flies all throws of a scenario and writes a directory of results:
//
//   scenario.resolved.yaml  every value spelled out
//   throws.csv, detections.csv, table.md, table.csv, and truth.csv on request: rows in throw order,
//                           byte-identical for any number of workers
//   timing.csv              computing time of each throw
//   manifest.json           commit, versions, machine, command line, throughput; written last, so a
//                           directory that has it is complete
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/campaign/result.h"
#include "sim/campaign/workers.h"
#include "sim/config/scenario.h"

namespace dodgesim {

struct CampaignOptions {
  std::filesystem::path out;
  int jobs = 1;
  bool force = false;        // overwrite whatever is in `out`
  std::string command_line;  // for the manifest
  // Name of the OpenGL renderer, for the manifest. Asked for after the workers have ended, because
  // no GL context may exist when they are forked; may be empty.
  std::function<std::string()> gl_renderer;
  bool show_progress = false;
  bool truth = false;  // write truth.csv, from the results' truth_rows
};

struct CampaignSummary {
  std::vector<ThrowResult> results;  // in throw order, without their detections
  std::string table;                 // Markdown
  int errors = 0;                    // throws of which a flight failed
  EventTruthSums truth;              // of all throws, when their results have it
  double wall_s = 0;
  double real_time_factor = 0;  // simulated time of the flown pilots per computing time, one core
};

// The result of throw `index` before any flight: its numbers as drawn. Requires a valid scenario.
ThrowResult blank_result(const Scenario& scenario, int index);

// Throws ScenarioError when `out` holds something else than a campaign of this very scenario and
// force is not set, or as `fly` does; IoError when a file cannot be written.
CampaignSummary run_campaign(const Scenario& scenario, const CampaignOptions& options,
                             const FlyFunction& fly);

}  // namespace dodgesim
