// The throws of a campaign.
#pragma once

#include "sim/config/scenario.h"

namespace dodgesim {

// Solves throws of the campaign without flying them: all, or kMostTriedThrows spread evenly over
// it. Throws ScenarioError for the first that is impossible: one that starts behind a wall or that
// the air stops. Returns how many were tried. After try_models() (try_models.h).
constexpr int kMostTriedThrows = 200;  // 2 s
int try_throws(const Scenario& campaign);

}  // namespace dodgesim
