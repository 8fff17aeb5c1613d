#include "sim/campaign/load_campaign.h"

#include "sim/campaign/journal.h"
#include "sim/campaign/result_files.h"

namespace dodgesim {

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
  return campaign;
}

}  // namespace dodgesim
