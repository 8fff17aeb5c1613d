// Results of throws that nobody flew, for tests of what becomes of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/tables/loaded_campaign.h"
#include "tests/sim/paper/synthetic_passage.h"

namespace dodgesim {

inline ThrowResult thrown(int index, bool would_hit, bool hit, const std::string& cause = "") {
  ThrowResult result;
  result.index = index;
  result.object = "ball";
  result.speed_mps = index % 2 == 0 ? 4 : 8;
  result.flown.status = result.none.status = result.oracle.status = "ok";
  result.none.hit = would_hit;
  result.flown.hit = hit;
  result.cause = cause;
  return result;
}

inline LoadedCampaign campaign(std::vector<ThrowResult> results) {
  LoadedCampaign campaign;
  campaign.scenario = paper_scenario("throw: {}\n");
  campaign.results = std::move(results);
  return campaign;
}

}  // namespace dodgesim
