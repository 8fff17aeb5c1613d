#include "sim/tables/loaded_campaign.h"

#include <utility>

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

}  // namespace dodgesim
