#include "sim/gate/comparison.h"

#include <algorithm>
#include <map>
#include <span>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/joined.h"
#include "sim/config/expand.h"

namespace dodgesim {

namespace {

using ByNumber = std::map<int, const ThrowOutcome*>;

ByNumber sorted(const std::vector<ThrowOutcome>& throws) {
  ByNumber by_number;
  for (const ThrowOutcome& t : throws) by_number[t.number] = &t;
  return by_number;
}

bool same_throws(const std::vector<ThrowOutcome>& first, const ByNumber& second) {
  bool any = false;
  for (const ThrowOutcome& a : first) {
    const auto b = second.find(a.number);
    if (b == second.end()) continue;
    if (!same_throw(a, *b->second)) return false;
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
  if (a.counts != b.counts) sum.counts_differ.push_back(a.number);
  if (!a.counts || !b.counts) return;
  sum.counts.add(a.success, b.success);
  if (a.success == b.success) return;
  (a.success ? sum.lost : sum.gained).push_back({a.number, a.label, a.what, b.what});
}

std::string rate_line(const std::string& name, const Proportion& rate) {
  const Interval interval = wilson(rate.successes, rate.trials);
  const double share =
      rate.trials == 0 ? 0 : static_cast<double>(rate.successes) / static_cast<double>(rate.trials);
  return name + formatted(": %lld of %lld succeeded (%.3f, %.3f to %.3f)\n",
                          static_cast<long long>(rate.successes),
                          static_cast<long long>(rate.trials), share, interval.lo, interval.hi);
}

std::string left_out(const std::vector<int>& throws, const std::string& why) {
  if (throws.empty()) return "";
  return "Left out, because " + why + ": throws " + list_of(throws) + "\n";
}

std::string text_of(const std::vector<AxisValue>& settings) {
  return settings.empty() ? "no grid or sweep" : label(settings);
}

double share_of(const Proportion& p) {
  return p.trials == 0 ? 0 : static_cast<double>(p.successes) / static_cast<double>(p.trials);
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

Comparison compare(const std::vector<ThrowOutcome>& first,
                   const std::vector<ThrowOutcome>& second) {
  const ByNumber by_number = sorted(second);
  Comparison sum;
  sum.paired = same_throws(first, by_number);
  if (!sum.paired) {
    sum.first = proportion(first);
    sum.second = proportion(second);
    return sum;
  }
  for (const ThrowOutcome& a : first) {
    const auto b = by_number.find(a.number);
    if (b != by_number.end()) {
      add_pair(a, *b->second, sum);
    } else {
      sum.unmatched.push_back(a.number);
    }
  }
  const ByNumber of_first = sorted(first);
  for (const ThrowOutcome& b : second) {
    if (of_first.count(b.number) == 0) sum.unmatched.push_back(b.number);
  }
  const PairedCounts& n = sum.counts;
  sum.first = {n.both + n.only_first, n.total()};
  sum.second = {n.both + n.only_second, n.total()};
  return sum;
}

std::string comparison_text(const Comparison& comparison, const std::string& first,
                            const std::string& second) {
  const Comparison& c = comparison;
  std::string text = rate_line(first, c.first) + rate_line(second, c.second);
  const double difference = share_of(c.second) - share_of(c.first);
  const Interval interval = c.paired ? tango(c.counts) : newcombe(c.first, c.second);
  const double p = c.paired ? mcnemar(c.counts) : boschloo(c.first, c.second);
  text += formatted("Difference: %+.3f (95 %%: %+.3f to %+.3f), p = %.3g, ", difference,
                    interval.lo, interval.hi, p);
  if (!c.paired) return text + "of different throws (Boschloo's test, Newcombe's interval)\n";
  text += formatted("of the same throws: %zu lost, %zu gained (McNemar's test, Tango's interval)\n",
                    c.lost.size(), c.gained.size());
  return text + left_out(c.unmatched, "only one campaign has them") +
         left_out(c.counts_differ, "they would have hit in one campaign only");
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
