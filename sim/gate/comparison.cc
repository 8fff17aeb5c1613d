#include "sim/gate/comparison.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/joined.h"
#include "sim/config/expand.h"

namespace dodgesim {

namespace {

// By sweep value and number within it.
class ByStream {
 public:
  explicit ByStream(const std::vector<ThrowOutcome>& throws) {
    for (const ThrowOutcome& t : throws) throws_[{t.sweep, t.stream}] = &t;
  }
  // The throw with the same numbers; null if there is none.
  const ThrowOutcome* like(const ThrowOutcome& t) const {
    const auto at = throws_.find({t.sweep, t.stream});
    return at == throws_.end() ? nullptr : at->second;
  }

 private:
  std::map<std::pair<int, std::int64_t>, const ThrowOutcome*> throws_;
};

bool can_be_paired(const std::vector<ThrowOutcome>& first, const ByStream& second) {
  bool any = false;
  for (const ThrowOutcome& a : first) {
    const ThrowOutcome* const b = second.like(a);
    if (b == nullptr) continue;
    if (!same_random_numbers(a, *b)) return false;
    any = true;
  }
  return any;
}

Proportion proportion(const std::vector<ThrowOutcome>& throws) {
  Proportion sum;
  for (const ThrowOutcome& t : throws) {
    if (!t.counts) continue;
    ++sum.trials;
    sum.successes += t.success ? 1 : 0;
  }
  return sum;
}

void add_pair(const ThrowOutcome& a, const ThrowOutcome& b, Comparison& sum) {
  ++sum.throws;
  for (const std::string& name : differing_draws(a, b)) {
    if (std::ranges::count(sum.differing, name) == 0) sum.differing.push_back(name);
  }
  if (a.counts != b.counts) sum.counts_differ.push_back(a.number);
  if (!a.counts || !b.counts) return;
  sum.counts.add(a.success, b.success);
  if (a.success == b.success) return;
  (a.success ? sum.lost : sum.gained).push_back({a.number, b.number, a.label, a.what, b.what});
}

double share_of(const Proportion& p) {
  return static_cast<double>(p.successes) / static_cast<double>(p.trials);
}

std::string rate_line(const std::string& name, const Proportion& rate) {
  if (rate.trials == 0) return name + ": 0 of 0 succeeded\n";
  const Interval interval = wilson(rate.successes, rate.trials);
  return name + formatted(": %lld of %lld succeeded (%.3f, %.3f to %.3f)\n",
                          static_cast<long long>(rate.successes),
                          static_cast<long long>(rate.trials), share_of(rate), interval.lo,
                          interval.hi);
}

std::string left_out(const std::vector<int>& throws, const std::string& why) {
  if (throws.empty()) return "";
  return "Left out, because " + why + ": throws " + list_of(throws) + "\n";
}

std::string pairs_text(const std::vector<std::string>& differing) {
  if (differing.empty()) return "of the same throws";
  return "of throws with the same random numbers (" + list_of(differing) +
         (differing.size() == 1 ? " differs)" : " differ)");
}

std::string text_of(const std::vector<AxisValue>& settings) {
  return settings.empty() ? "no grid or sweep" : label(settings);
}

std::string difference_text(const Comparison& c) {
  if (!c.has_rates()) {
    const std::string none =
        c.paired ? "no throw could be flown and would have hit in both"
                 : "one of the two has no throw that could be flown and would have hit";
    return "No difference can be told: " + none + "\n";
  }
  const Interval interval = c.paired ? tango(c.counts) : newcombe(c.first, c.second);
  const double p = c.paired ? mcnemar(c.counts) : boschloo(c.first, c.second);
  const std::string text =
      formatted("Difference: %+.3f (95 %%: %+.3f to %+.3f), p = %.3g, ",
                share_of(c.second) - share_of(c.first), interval.lo, interval.hi, p);
  if (!c.paired) return text + "of different throws (Boschloo's test, Newcombe's interval)\n";
  return text + pairs_text(c.differing) +
         formatted(": %zu lost, %zu gained (McNemar's test, Tango's interval)\n", c.lost.size(),
                   c.gained.size());
}

}  // namespace

void expect_same_settings(const std::vector<ThrowOutcome>& first,
                          const std::vector<ThrowOutcome>& second, const std::string& first_name,
                          const std::string& second_name) {
  std::map<std::pair<int, int>, const ThrowOutcome*> of_first;
  for (const ThrowOutcome& t : first) of_first[{t.cell, t.sweep}] = &t;
  for (const ThrowOutcome& b : second) {
    const auto a = of_first.find({b.cell, b.sweep});
    if (a == of_first.end() || a->second->settings == b.settings) continue;
    throw ScenarioError(first_name + " has " + text_of(a->second->settings) + " where " +
                        second_name + " has " + text_of(b.settings) +
                        "; campaigns can be compared if their grids and sweeps are the same.");
  }
}

void expect_same_cells(const std::vector<ThrowOutcome>& first,
                       const std::vector<ThrowOutcome>& second, const std::string& first_name,
                       const std::string& second_name) {
  const auto expect_cells_of = [](const std::vector<ThrowOutcome>& some, const std::string& name,
                                  const std::vector<ThrowOutcome>& others,
                                  const std::string& other_name) {
    std::set<int> cells;
    for (const ThrowOutcome& t : others) cells.insert(t.cell);
    for (const ThrowOutcome& t : some) {
      if (cells.contains(t.cell)) continue;
      throw ScenarioError(name + " has throws of " + text_of(t.settings) + ", " + other_name +
                          " has none; campaigns of different throws can be compared if they have "
                          "throws in the same cells of the grid.");
    }
  };
  expect_cells_of(first, first_name, second, second_name);
  expect_cells_of(second, second_name, first, first_name);
}

Comparison compare(const std::vector<ThrowOutcome>& first,
                   const std::vector<ThrowOutcome>& second) {
  const ByStream of_first(first), of_second(second);
  Comparison sum;
  sum.paired = can_be_paired(first, of_second);
  if (!sum.paired) {
    sum.first = proportion(first);
    sum.second = proportion(second);
    return sum;
  }
  for (const ThrowOutcome& a : first) {
    const ThrowOutcome* const b = of_second.like(a);
    if (b != nullptr) {
      add_pair(a, *b, sum);
    } else {
      sum.only_first.push_back(a.number);
    }
  }
  for (const ThrowOutcome& b : second) {
    if (of_first.like(b) == nullptr) sum.only_second.push_back(b.number);
  }
  const PairedCounts& n = sum.counts;
  sum.first = {n.both + n.only_first, n.total()};
  sum.second = {n.both + n.only_second, n.total()};
  return sum;
}

std::string comparison_text(const Comparison& comparison, const std::string& first,
                            const std::string& second) {
  const Comparison& c = comparison;
  const std::string text =
      rate_line(first, c.first) + rate_line(second, c.second) + difference_text(c);
  return text + left_out(c.only_first, "only " + first + " has them") +
         left_out(c.only_second, "only " + second + " has them") +
         left_out(c.counts_differ,
                  "in one of the two they would have missed, or nobody could fly them");
}

std::string list_of(const std::vector<std::string>& items) {
  constexpr std::size_t kMost = 10;
  std::string text = joined(std::span(items).first(std::min(items.size(), kMost)));
  if (items.size() > kMost) text += " and " + std::to_string(items.size() - kMost) + " more";
  return text;
}

std::string list_of(const std::vector<int>& numbers) {
  std::vector<std::string> items;
  items.reserve(numbers.size());
  for (const int number : numbers) items.push_back(std::to_string(number));
  return list_of(items);
}

}  // namespace dodgesim
