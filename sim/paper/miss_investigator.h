// Why throws of a campaign were missed.
#pragma once

#include <map>
#include <vector>

#include "sim/paper/miss.h"
#include "sim/paper/success.h"
#include "sim/tables/loaded_campaign.h"

namespace dodgesim {

// Flies a throw again, once, when it is asked about.
class MissInvestigator {
 public:
  explicit MissInvestigator(const LoadedCampaign& campaign) : campaign_(campaign) {}

  // How far the pilot got at best while the ball's centre was in view in the bin, with windows of
  // events that end in [from_us, to_us).
  Miss reason(int throw_index, const RangeBin& bin, TimeUs from_us, TimeUs to_us);

 private:
  const std::vector<ObservedCycle>& cycles(int throw_index);

  const LoadedCampaign& campaign_;
  std::map<int, std::vector<ObservedCycle>> flights_;
};

}  // namespace dodgesim
