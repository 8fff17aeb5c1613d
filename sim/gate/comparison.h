// Two campaigns side by side: what became of their throws.
#pragma once

#include <string>
#include <vector>

#include "sim/gate/outcomes.h"
#include "sim/statistics/paired.h"
#include "sim/statistics/unpaired.h"

namespace dodgesim {

// A throw that succeeded in one campaign only.
struct ChangedThrow {
  int number = 0, number_after = 0;  // another one where other repeats shift those of a sweep value
  std::string label;
  std::string before, after;  // ThrowOutcome::what
};

struct Comparison {
  bool paired = false;  // all throws that both have share their random numbers
  int throws = 0;       // in both, by their numbers within the sweep value
  // When paired, what was drawn otherwise (differing_draws()), or differs else; empty: they are the
  // same throws.
  std::vector<std::string> differing;
  Proportion first, second;  // successes of the throws that count; paired: in both campaigns
  PairedCounts counts;       // when paired
  // When paired, numbers of the throws that cannot be compared and are in no count: those that only
  // one campaign has, and those that count in only one (ThrowOutcome::counts).
  std::vector<int> only_first, only_second, counts_differ;
  std::vector<ChangedThrow> lost, gained;  // when paired

  // Without them there is no difference to test, which is not a difference of zero.
  bool has_rates() const { return first.trials > 0 && second.trials > 0; }
};

// Throws ScenarioError, which names the campaigns as given, if a cell of the grid or a value of the
// sweep that both have is not the same in both: their throws are of different experiments.
void expect_same_settings(const std::vector<ThrowOutcome>& first,
                          const std::vector<ThrowOutcome>& second, const std::string& first_name,
                          const std::string& second_name);

// Likewise, if one has throws in a cell of the grid where the other has none: rates of different
// throws would differ by their cells. Pairs need no such thing, as they are counted in both.
void expect_same_cells(const std::vector<ThrowOutcome>& first,
                       const std::vector<ThrowOutcome>& second, const std::string& first_name,
                       const std::string& second_name);

// Throws with the same number within the same sweep value are pairs if all of these share their
// random numbers (same_random_numbers()): a pair's outcomes may depend on each other, but not on
// those of other pairs.
Comparison compare(const std::vector<ThrowOutcome>& first, const std::vector<ThrowOutcome>& second);

// The comparison in words: rates and, if both have one, difference with its interval and p-value.
// `first` and `second` name the campaigns.
std::string comparison_text(const Comparison& comparison, const std::string& first,
                            const std::string& second);

// "3, 7, 9"; the first ten if there are more.
std::string list_of(const std::vector<std::string>& items);
std::string list_of(const std::vector<int>& numbers);

}  // namespace dodgesim
