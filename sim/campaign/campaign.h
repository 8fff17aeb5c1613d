// Flies all throws of a scenario and writes a directory of results:
//
//   scenario.resolved.yaml  every value spelled out
//   results.bin             every result as it came (journal.h): what --resume and merge go on with
//   throws.csv, objects.csv, detections.csv, table.md, table.csv, truth.csv (on request)
//                           byte-identical for any number of workers, shards and resumes
//                           (result_files.h)
//   report.html             charts, and every throw in 3-D (report.h)
//   timing.csv              computing time of each throw
//   manifest.json           commit, versions, machine, command line, throughput; written last, so a
//                           directory that has it is complete
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/campaign/shard.h"
#include "sim/campaign/workers.h"
#include "sim/config/expand.h"
#include "sim/outcome/result.h"

namespace dodgesim {

struct CampaignOptions {
  std::filesystem::path out;
  int jobs = 1;
  bool force = false;   // start anew, whatever results are in `out`
  bool resume = false;  // fly what is missing in `out`
  Shard shard;
  WorkerLimits limits;
  // Digest of the scenario's models (sim/preflight/try_models.h) before all flights.
  std::string models;
  std::string plugin;        // digest of the library, if one of the pilots comes from it
  std::string command_line;  // for the manifest
  // Name of the OpenGL renderer, for the manifest; may be empty. It must not leave a GL context in
  // this process, which forks workers.
  std::function<std::string()> gl_renderer;
  bool show_progress = false;
  bool truth = false;          // write truth.csv, from the results' truth_rows
  std::function<bool()> stop;  // see WorkerTasks
};

struct CampaignSummary {
  std::vector<ThrowResult> results;   // in throw order, without rows (drop_rows())
  int wanted = 0;                     // throws of the shard
  int missing = 0;                    // of these, not flown yet because somebody stopped it
  std::string table;                  // Markdown: Tables::overview
  int errors = 0;                     // throws of which a flight failed
  std::vector<EventTruthSums> truth;  // by value of the sweep, when the results have it
  double wall_s = 0;                  // of this run, from its first throw's begin to the tables
  double real_time_factor = 0;  // simulated time of the flown pilots per computing time, one core
  WorkerMemory memory;          // of this run
  int flown = 0;                // throws of this run

  bool complete() const { return missing == 0; }
};

// Flies one throw. ScenarioError means that no throw of this scenario can be flown; any other
// exception costs this throw.
using FlyFunction = std::function<ThrowResult(int throw_index)>;

// Flies the throws with `fly`. If it is stopped, nothing but the journal is written. Throws
// ScenarioError, also if `out` holds something else or another process is writing there, and
// IoError; what was flown stays in the journal.
CampaignSummary run_campaign(const Scenario& scenario, const CampaignOptions& options,
                             const FlyFunction& fly);

// What to fly, where to, and how.
struct PlannedCampaign {
  const Scenario* scenario = nullptr;  // must outlive it
  CampaignOptions options;
  FlyFunction fly;
};

// Hears of campaigns by their number; either function may be empty.
struct CampaignListener {
  std::function<void(std::size_t)> begun;
  // All results are written, or somebody has stopped it after it was begun. The summary lacks the
  // workers' memory.
  std::function<void(std::size_t, CampaignSummary)> ended;
};

// The same for several campaigns, one after the other, but workers that find no throw of one any
// more begin the next while its last throws are in the air, so that the times of neighbours
// overlap. All directories are made, locked and looked through before the first throw. jobs, limits
// and stop are those of the first campaign. Throws in the air when a campaign ends early (the
// scenario's key stop) do not count. After an exception, too, every journal has what was flown, and
// those campaigns that were told to have ended are whole.
WorkerMemory run_campaigns(const std::vector<PlannedCampaign>& plans,
                           const CampaignListener& listener);

}  // namespace dodgesim
