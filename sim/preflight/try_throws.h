// The throws of a campaign.
#pragma once

#include <string>

#include "sim/config/scenario.h"

namespace dodgesim {

// Of the simulated time of throws that are tried.
inline constexpr double kMostSolvedS = 60;  // 1 to 3 s of computing
inline constexpr double kMostTriedS = 240;

struct TriedThrows {
  int solved = 0;
  // A sentence on the first whose vehicle, by itself, crashes or turns about where it is to hover,
  // before it is thrown at; empty if there is none.
  std::string trouble;
};

// Solves throws of the campaign and launches them at a vehicle without a pilot, as many as take
// kMostSolvedS of simulated time in sum, and one at least unless that takes more than kMostTriedS;
// every cell before any has a second.
// Throws ScenarioError for the first one that is impossible, with how many are: it starts behind a
// wall or inside something, or the air stops it. After try_models() (try_models.h).
TriedThrows try_throws(const Scenario& campaign);

}  // namespace dodgesim
