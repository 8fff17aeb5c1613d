#include "sim/tables/early_stop.h"

#include <algorithm>

#include "sim/base/formatted.h"
#include "sim/config/expand.h"

namespace dodgesim {

EarlyStop::EarlyStop(const Scenario& scenario)
    : spec_(scenario.stop.value()),
      planned_(throw_count(scenario)),
      rule_(spec_.half_width, spec_.confidence, planned_) {}

void EarlyStop::add(const ThrowResult& result) {
  if (end_) return;
  waiting_[result.index].add(result);
  for (auto first = waiting_.begin(); first != waiting_.end() && first->first == next_;
       first = waiting_.erase(first)) {
    sum_.would_have_hit += first->second.would_have_hit;
    sum_.dodged += first->second.dodged;
    ++next_;
    if (all_flown() || !rule_.done(sum_.dodged, sum_.would_have_hit)) continue;
    end_ = next_;
    waiting_.clear();
    break;
  }
  if (end_ || all_flown()) last_interval_ = find_last_interval();
}

EarlyStop::SoFar EarlyStop::so_far() const {
  SoFar sum = {next_, sum_.dodged, sum_.would_have_hit};
  for (const auto& [number, tally] : waiting_) {
    ++sum.throws;
    sum.dodged += tally.dodged;
    sum.would_have_hit += tally.would_have_hit;
  }
  return sum;
}

SequentialInterval EarlyStop::interval() const {
  if (last_interval_) return {*last_interval_, spec_.confidence};
  const SoFar sum = so_far();
  return {confidence_sequence(sum.dodged, sum.would_have_hit, spec_.confidence), spec_.confidence};
}

// Which throws would have hit does not depend on the pilot: nobody dodges there.
Interval EarlyStop::find_last_interval() const {
  const int dodged = sum_.dodged, trials = sum_.would_have_hit;
  if (trials == 0) return {0, 1};
  return (end_ ? rule_ : rule_.run_out(trials)).interval(dodged, trials);
}

std::string EarlyStop::text() const {
  const auto [throws, dodged, trials] = so_far();
  const Interval interval = this->interval().interval;
  const std::string counts = formatted("%d of %d dodged, %.4g %% interval %.3f to %.3f", dodged,
                                       trials, 100 * spec_.confidence, interval.lo, interval.hi);
  const std::string asked = formatted("asked for: +- %g).", spec_.half_width);
  if (end_ || !all_flown()) {
    return formatted("%s after %d throws: ", end_ ? "Ended by stop" : "Not ended by stop", throws) +
           counts + " (valid though the results decided when to stop; " + asked;
  }
  const double rate = trials > 0 ? static_cast<double>(dodged) / trials : 0.5;
  return formatted("All %d throws flown: ", throws) + counts +
         formatted(" (valid though the results could have stopped it; known to +- %.3f, ",
                   std::max(interval.hi - rate, rate - interval.lo)) +
         asked;
}

}  // namespace dodgesim
