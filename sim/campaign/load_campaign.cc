#include "sim/campaign/load_campaign.h"

#include "sim/campaign/early_stop.h"
#include "sim/campaign/journal.h"
#include "sim/campaign/result_files.h"

namespace dodgesim {

namespace {

// Throws that were flown while the campaign came to its early end.
void drop_beyond_end(LoadedCampaign& campaign) {
  EarlyStop stop(campaign.scenario);
  for (const ThrowResult& result : campaign.results) stop.add(result);
  if (!stop.end()) return;
  std::erase_if(campaign.results,
                [&](const ThrowResult& result) { return result.index >= *stop.end(); });
}

}  // namespace

LoadedCampaign load_campaign(const std::filesystem::path& directory) {
  const std::filesystem::path journal = directory / kJournalFile;
  const JournalIndex index = read_journal(journal);
  LoadedCampaign campaign;
  campaign.scenario = parse_scenario(index.identity.scenario, kScenarioFile, "");
  campaign.program = index.identity.program;
  for_each_result(journal, index, [&](ThrowResult result) {
    result.truth_rows = {};
    result.detection_rows = {};
    result.object_rows = {};
    campaign.results.push_back(std::move(result));
  });
  if (campaign.scenario.stop) drop_beyond_end(campaign);
  return campaign;
}

}  // namespace dodgesim
