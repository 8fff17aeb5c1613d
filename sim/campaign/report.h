// report.html: one page that shows a campaign, with every throw in three dimensions. It holds all
// that it needs and works offline.
#pragma once

#include <string>

#include "sim/campaign/load_campaign.h"

namespace dodgesim {

inline constexpr const char* kReportFile = "report.html";

// `directory`: where the campaign lies, as it is to stand in the lines that replay a throw.
std::string report_html(const LoadedCampaign& campaign, const std::string& directory);

}  // namespace dodgesim
