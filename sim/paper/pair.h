// The same throws flown by two pilots.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "sim/statistics/paired.h"
#include "sim/tables/loaded_campaign.h"
#include "sim/tables/throw_statistics.h"

namespace dodgesim {

// Calls `both` with the two results of each throw. The campaigns hold the same throws; throws
// std::invalid_argument if they do not.
void for_each_throw(const LoadedCampaign& first_flew, const LoadedCampaign& second_flew,
                    const std::function<void(const ThrowResult&, const ThrowResult&)>& both);

// Counts over the throws that would have hit: tallies and pairs are of the same ones.
struct PilotPair {
  Tally first, second, oracle;  // the oracle with the first pilot's avoidance
  PairedCounts paired;          // dodged by the first and by the second
  std::map<std::string, int> first_causes, second_causes;  // of hits and crashes

  // Counts the throws that belong. The campaigns hold the same throws, as in for_each_throw().
  void add(const LoadedCampaign& first_flew, const LoadedCampaign& second_flew,
           const std::function<bool(const ThrowResult&)>& belongs);
};

// "0.0243", or "< 0.0001".
std::string p_text(double p);

}  // namespace dodgesim
