// A campaign read back from its directory.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/campaign/result.h"
#include "sim/config/expand.h"

namespace dodgesim {

struct LoadedCampaign {
  Scenario scenario;
  std::string program;               // version and commit that flew it
  std::vector<ThrowResult> results;  // in throw order, without rows of detections and objects

  bool complete() const { return static_cast<int>(results.size()) == throw_count(scenario); }
};

// Reads results.bin, also of a campaign under way. Throws IoError if it is none.
LoadedCampaign load_campaign(const std::filesystem::path& directory);

}  // namespace dodgesim
