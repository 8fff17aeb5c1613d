// report.html: one page that shows a campaign, with every throw in three dimensions. It holds all
// that it needs and works offline.
#pragma once

#include <string>

#include "sim/tables/loaded_campaign.h"

namespace dodgesim {

inline constexpr const char* kReportFile = "report.html";

// `directory`: where the campaign lies, as it is to stand in the lines that replay a throw.
std::string report_html(const LoadedCampaign& campaign, const std::string& directory);

// What flies a throw of that campaign again, but for its number, which comes last. A campaign that
// was read back does not say where its models and its plug-in are.
std::string replay_line(const std::string& directory, const Scenario& scenario);

}  // namespace dodgesim
