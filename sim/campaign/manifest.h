// manifest.json: what is needed to judge whether two campaigns can be compared, and to fly one
// again.
#pragma once

#include <string>

#include "sim/campaign/campaign.h"

namespace dodgesim {

std::string manifest_json(const Scenario& scenario, const CampaignOptions& options,
                          const CampaignSummary& summary, const std::string& started);

// "2026-01-31T12:00:00Z". For people; no result depends on it.
std::string utc_now();

}  // namespace dodgesim
