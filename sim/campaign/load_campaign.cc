#include "sim/campaign/load_campaign.h"

#include <utility>

#include "sim/campaign/journal.h"
#include "sim/campaign/result_files.h"

namespace dodgesim {

LoadedCampaign campaign_of(Scenario scenario, std::string program,
                           std::vector<ThrowResult> results) {
  LoadedCampaign campaign = {
      std::move(scenario), std::move(program), std::move(results), {}, false};
  if (!campaign.scenario.stop) return campaign;
  campaign.stop.emplace(campaign.scenario);
  for (const ThrowResult& result : campaign.results) campaign.stop->add(result);
  if (!campaign.ended_early()) return campaign;
  std::erase_if(campaign.results, [end = *campaign.stop->end()](const ThrowResult& result) {
    return result.index >= end;
  });
  return campaign;
}

std::vector<Part> parts_of(const LoadedCampaign& campaign) {
  std::vector<Part> parts = parts_of(campaign.results, campaign.scenario.pilot);
  // The key stop excludes a sweep: there is one part.
  if (campaign.stop) parts.front().sequential = campaign.stop->interval();
  return parts;
}

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
