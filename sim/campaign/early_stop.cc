#include "sim/campaign/early_stop.h"

#include "sim/base/formatted.h"
#include "sim/config/expand.h"

namespace dodgesim {

EarlyStop::EarlyStop(const Scenario& scenario)
    : spec_(scenario.stop.value()),
      rule_(spec_.half_width, spec_.confidence, throw_count(scenario)) {}

void EarlyStop::add(const ThrowResult& result) {
  if (end_) return;
  waiting_[result.index].add(result);
  for (auto first = waiting_.begin(); first != waiting_.end() && first->first == next_;
       first = waiting_.erase(first)) {
    sum_.would_have_hit += first->second.would_have_hit;
    sum_.dodged += first->second.dodged;
    ++next_;
    if (!rule_.done(sum_.dodged, sum_.would_have_hit)) continue;
    end_ = next_;
    waiting_.clear();
    return;
  }
}

SequentialInterval EarlyStop::interval() const {
  return {end_ ? rule_.interval(sum_.dodged, sum_.would_have_hit)
               : confidence_sequence(sum_.dodged, sum_.would_have_hit, spec_.confidence),
          spec_.confidence};
}

std::string EarlyStop::text() const {
  const Interval interval = this->interval().interval;
  return formatted(
      "%s after %d throws: %d of %d dodged, %.4g %% interval %.3f to %.3f (valid though the "
      "results decided when to stop; asked for: +- %g).",
      end_ ? "Ended by stop" : "Not ended by stop", next_, sum_.dodged, sum_.would_have_hit,
      100 * spec_.confidence, interval.lo, interval.hi, spec_.half_width);
}

}  // namespace dodgesim
