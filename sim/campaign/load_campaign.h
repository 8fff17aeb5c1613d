// A campaign read back from its directory.
#pragma once

#include <filesystem>
#include <string>

#include "sim/tables/loaded_campaign.h"

namespace dodgesim {

// Of objects, detections and causes of events: few need them, and they are most of a campaign.
enum class Rows { kDrop, kKeep };

// Reads results.bin, also of a campaign under way. `models_dir` is as in parse_scenario().
// Throws IoError if there is none.
LoadedCampaign load_campaign(const std::filesystem::path& directory,
                             const std::string& models_dir = "", Rows rows = Rows::kDrop);

}  // namespace dodgesim
