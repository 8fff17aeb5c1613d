#include "sim/paper/miss_investigator.h"

#include "sim/config/expand.h"
#include "sim/loop.h"

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
  const ThrowCase again = case_of(campaign_.scenario, throw_index);
  MissObserver observer(again.scenario);
  fly(again.scenario, plan_throw(again.scenario, again.stream), &observer);
  return flights_.emplace(throw_index, observer.cycles()).first->second;
}

}  // namespace dodgesim
