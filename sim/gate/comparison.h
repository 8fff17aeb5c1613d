// Two campaigns side by side: what became of their throws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/campaign/paired.h"
#include "sim/campaign/statistics.h"
#include "sim/campaign/unpaired.h"
#include "sim/gate/csv_table.h"

namespace dodgesim {

// What a throws.csv says about one throw.
struct ThrowOutcome {
  int number = 0;
  int sweep = 0;         // number of the sweep value
  std::string label;     // "0.2 m ball, 5.1 m/s from 3.2 m", or "quiet flight"
  std::string draw;      // everything that was drawn: the same text is the same throw
  bool counts = false;   // it would have hit, or nobody threw
  bool success = false;  // neither hit nor crashed; without a throw, no dodge either
  std::string what;      // "dodged", "hit", "crashed", "evaded nothing", "error: ..."
};

// Columns of throws.csv that say what was drawn for a throw, before anything flies.
const std::vector<std::string>& drawn_columns();

// In the order of the table. Throws IoError if the table is not that of a campaign.
std::vector<ThrowOutcome> outcomes(const CsvTable& throws);

// A throw that succeeded in one campaign only.
struct ChangedThrow {
  int number = 0;
  std::string label;
  std::string before, after;  // ThrowOutcome::what
};

struct Comparison {
  bool paired = false;       // all throws that both have are the same throws
  int unmatched = 0;         // throws in one of them only, left out when paired
  int throws = 0;            // in both, by their numbers
  Proportion first, second;  // successes of the throws that count; paired: in both campaigns
  PairedCounts counts;       // when paired
  int counts_differ = 0;     // paired: they would have hit in one campaign only, and are left out
  std::vector<ChangedThrow> lost, gained;  // when paired
};

Comparison compare(const std::vector<ThrowOutcome>& first, const std::vector<ThrowOutcome>& second);

// The comparison in words: rates, difference with its interval, p-value. `first` and `second` name
// the campaigns.
std::string comparison_text(const Comparison& comparison, const std::string& first,
                            const std::string& second);

}  // namespace dodgesim
