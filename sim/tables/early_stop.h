// Ends a campaign when its success rate is known well enough: `stop: {half_width: 0.03}`.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "sim/config/scenario.h"
#include "sim/outcome/result.h"
#include "sim/statistics/sequential.h"
#include "sim/tables/throw_statistics.h"

namespace dodgesim {

// Results may be added in any order, as workers finish: the end depends on the throws in the order
// of their numbers alone.
class EarlyStop {
 public:
  // Requires scenario.stop.
  explicit EarlyStop(const Scenario& scenario);

  void add(const ThrowResult& result);

  // After how many throws, fewer than the scenario's, the campaign ends; empty: not yet.
  std::optional<int> end() const { return end_; }

  // Of the success rate over the throws so far or, after the end, over those before it. It holds
  // although the campaign chose when to stop; of a campaign under way it is much wider. Throws that
  // came before an earlier one count here, because tables count them: while a campaign is under way
  // as many as it has workers, after damage to its journal all behind the gap.
  SequentialInterval interval() const;

  // Of the throws so far or, after the end, of those before it: dodged of those that would have
  // hit, with that interval. One sentence.
  std::string text() const;

 private:
  // What interval() and text() speak of.
  struct SoFar {
    int throws = 0, dodged = 0, would_have_hit = 0;
  };
  SoFar so_far() const;

  bool all_flown() const { return next_ == planned_; }
  Interval find_last_interval() const;

  StopSpec spec_;
  int planned_;  // throws of the scenario
  FixedWidthRule rule_;
  std::map<int, Tally> waiting_;  // throws that came before an earlier one
  int next_ = 0;                  // number of the throw that is counted next
  Tally sum_;
  std::optional<int> end_;
  std::optional<Interval> last_interval_;  // when the campaign has ended
};

}  // namespace dodgesim
