// The tables that a campaign ends with: table.md for people, table.csv for programs.
#pragma once

#include <string>
#include <vector>

#include "sim/campaign/result.h"

namespace dodgesim {

struct Tables {
  std::string markdown;
  std::string csv;  // to_csv() of statistics_table.h by size, distance, both, and speed
};

// `results` in throw order; `title` and `pilot` are the scenario's. Values of the sweep stand
// apart.
Tables make_tables(const std::vector<ThrowResult>& results, const std::string& title,
                   const std::string& pilot);

}  // namespace dodgesim
