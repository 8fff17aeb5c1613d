// The tables that a campaign ends with: table.md for people, table.csv for programs.
#pragma once

#include <string>

#include "sim/tables/loaded_campaign.h"

namespace dodgesim {

struct Tables {
  std::string markdown;
  std::string overview;  // the same, but of a sweep the rates of its cells alone
  std::string csv;       // to_csv() of statistics_table.h by size, distance, both, speed and cell
};

// Values of the sweep stand apart.
Tables make_tables(const LoadedCampaign& campaign);

}  // namespace dodgesim
