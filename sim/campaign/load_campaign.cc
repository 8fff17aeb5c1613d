#include "sim/campaign/load_campaign.h"

#include <utility>

#include "sim/campaign/campaign_files.h"
#include "sim/campaign/journal.h"

namespace dodgesim {

LoadedCampaign load_campaign(const std::filesystem::path& directory, const std::string& models_dir,
                             Rows rows) {
  const std::filesystem::path journal = directory / kJournalFile;
  const JournalIndex index = read_journal(journal);
  std::vector<ThrowResult> results;
  for_each_result(journal, index, [&](ThrowResult result) {
    if (rows == Rows::kDrop) result.drop_rows();
    results.push_back(std::move(result));
  });
  LoadedCampaign campaign =
      campaign_of(parse_scenario(index.identity.scenario, kScenarioFile, models_dir),
                  index.identity.program, std::move(results));
  campaign.damaged = index.damaged > 0;
  return campaign;
}

}  // namespace dodgesim
