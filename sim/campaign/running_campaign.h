// A campaign while its throws are flown: which is the next, and what has come back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/base/wall_clock.h"
#include "sim/campaign/campaign.h"
#include "sim/campaign/campaign_directory.h"
#include "sim/campaign/journal.h"
#include "sim/tables/early_stop.h"

namespace dodgesim {

class RunningCampaign {
 public:
  // Locks options.out and looks what it holds, but changes nothing of it; scenario and options must
  // outlive it. Throws ScenarioError and IoError, as run_campaign().
  RunningCampaign(const Scenario& scenario, const CampaignOptions& options);

  // Writes what is there before the first throw; what is to be overwritten goes. Throws IoError.
  void prepare();
  void begin();  // CampaignSummary::wall_s counts from here
  // The throw to begin next; nothing when all were begun or the scenario's `stop` has ended it.
  std::optional<int> next();
  void add(const ThrowResult& result);  // throws IoError

  int to_fly() const { return static_cast<int>(throws_.size()); }
  int flown() const { return summary_.flown; }
  // No result is awaited any more.
  bool over() const;

  // Writes the results, unless somebody has stopped it before it was over.
  CampaignSummary finish();

 private:
  std::optional<int> early_end() const;

  const Scenario& scenario_;
  const CampaignOptions& options_;
  WallClock::time_point begin_;
  std::string started_;
  DirectoryLock lock_;
  CampaignIdentity identity_;
  std::optional<JournalIndex> found_;  // to go on with
  std::optional<EarlyStop> stop_;
  std::optional<Journal> journal_;
  std::vector<int> throws_;  // to fly, in the order in which they are begun
  std::size_t next_ = 0;     // of throws_
  CampaignSummary summary_;
};

}  // namespace dodgesim
