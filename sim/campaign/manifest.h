// manifest.json: what is needed to judge whether two campaigns can be compared, and to fly one
// again.
#pragma once

#include <filesystem>
#include <string>

#include "sim/campaign/campaign.h"
#include "sim/files/json.h"

namespace dodgesim {

// The manifest's groups "program" and "machine", also for other files that say what made them.
Json program_group();
Json machine_group();

// A merged campaign's program and machine are those that merged it. merge.h adds the manifests of
// its parts.
Json manifest_of(const Scenario& scenario, const CampaignOptions& options,
                 const CampaignSummary& summary, const std::string& started);

// That of the campaign in the directory. Throws IoError.
Json read_manifest(const std::filesystem::path& directory);

// "2026-01-31T12:00:00Z". For people; no result depends on it.
std::string utc_now();

}  // namespace dodgesim
