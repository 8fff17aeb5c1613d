// The throws of a campaign.
#pragma once

#include <string>

#include "sim/config/scenario.h"

namespace dodgesim {

// Solves throws of the campaign and launches them at a vehicle without a pilot, as many as take
// kMostSolvedS of simulated time in sum, and one at least unless that takes more than kMostTriedS;
// every cell before any has a second.
// Throws ScenarioError for one that is impossible: it starts behind a wall or inside something, or
// the air stops it. After try_models() (try_models.h).
inline constexpr double kMostSolvedS = 120;  // 2 s of computing
inline constexpr double kMostTriedS = 480;
struct TriedThrows {
  int solved = 0;
  std::string crash;  // a sentence on the first whose vehicle crashes before it is thrown
};
TriedThrows try_throws(const Scenario& campaign);

}  // namespace dodgesim
