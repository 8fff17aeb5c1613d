#include "sim/tables/loaded_campaign.h"

#include <cstdint>
#include <utility>

#include "sim/base/formatted.h"

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

std::string LoadedCampaign::losses() const {
  constexpr double kWorthASentence = 0.01;
  std::int64_t lost = 0, all = 0;
  for (const ThrowResult& result : results) {
    for (std::size_t camera = 0; camera < result.events.size(); ++camera) {
      lost += result.events_lost[camera];
      all += result.events[camera] + result.events_lost[camera];
    }
  }
  const double share = all > 0 ? static_cast<double>(lost) / static_cast<double>(all) : 0;
  if (share < kWorthASentence) return "";
  return formatted(
      "The readout of the event cameras lost %.0f %% of their events, which no pilot saw "
      "(sensors.events.readout_max_hz).",
      100 * share);
}

}  // namespace dodgesim
