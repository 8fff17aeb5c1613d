// A campaign read back from its directory.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/campaign/result.h"
#include "sim/config/scenario.h"

namespace dodgesim {

struct LoadedCampaign {
  Scenario scenario;
  std::string program;               // version and commit that flew it
  std::vector<ThrowResult> results;  // in throw order, without the rows of their detections

  bool complete() const { return static_cast<int>(results.size()) == scenario.repeats; }
};

// Reads results.bin, also of a campaign under way. Throws IoError if it is none.
LoadedCampaign load_campaign(const std::filesystem::path& directory);

}  // namespace dodgesim
