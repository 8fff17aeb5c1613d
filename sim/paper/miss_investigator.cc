#include "sim/paper/miss_investigator.h"

#include "sim/config/expand.h"
#include "sim/flight/fly_throw.h"

namespace dodgesim {

Miss MissInvestigator::reason(int throw_index, const RangeBin& bin, TimeUs from_us, TimeUs to_us) {
  std::vector<ObservedCycle> inside;
  for (const ObservedCycle& cycle : cycles(throw_index)) {
    if (cycle.centre_in_view && bin.contains(cycle.range_m) && cycle.t_us >= from_us &&
        cycle.t_us < to_us) {
      inside.push_back(cycle);
    }
  }
  const dodge::Config& dodger = campaign_.scenario.dodger;
  return miss_of(inside, dodger.position, dodger.cluster.min_events);
}

const std::vector<ObservedCycle>& MissInvestigator::cycles(int throw_index) {
  const auto known = flights_.find(throw_index);
  if (known != flights_.end()) return known->second;
  MissObserver observer(case_of(campaign_.scenario, throw_index).scenario);
  fly_throw(campaign_.scenario, throw_index, &observer);
  return flights_.emplace(throw_index, observer.cycles()).first->second;
}

}  // namespace dodgesim
