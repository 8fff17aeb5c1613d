// The results of several directories as those of one campaign.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/campaign/campaign.h"

namespace dodgesim {

// Puts the results of several directories (shards of one campaign, in any order, some perhaps
// twice) together in options.out, as if one process had flown them. A throw that was lost with its
// worker in one of them and flown in another counts as flown. Throws ScenarioError if they are of
// different campaigns or contradict each other, MissingThrows, IoError.
CampaignSummary merge_campaigns(const std::vector<std::filesystem::path>& directories,
                                const CampaignOptions& options);

// The number of throws, if merge_campaigns() would find all of them; throws as it does.
int expect_complete(const std::vector<std::filesystem::path>& directories);

}  // namespace dodgesim
