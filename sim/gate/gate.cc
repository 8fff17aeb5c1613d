#include "sim/gate/gate.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "sim/base/contains.h"
#include "sim/base/formatted.h"
#include "sim/files/markup.h"

namespace dodgesim {

namespace {

constexpr const char* kJunitHead = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites";

using Result = GateCheck::Result;

GateCheck every_throw_flew(const CsvTable& flown) {
  std::vector<std::string> failed;
  for (std::size_t row = 0; row < flown.rows(); ++row) {
    for (const char* flight : {"flown", "none", "oracle"}) {
      const std::string& status = flown.at(row, flight + std::string("_status"));
      if (status == "ok" || status == "not flown") continue;
      failed.push_back(flown.at(row, "throw") + " (" + flight + ": " +
                       flown.at(row, flight + std::string("_error")) + ")");
    }
  }
  GateCheck check{"every throw was flown", Result::kPassed, ""};
  if (failed.empty()) return check;
  return {check.name, Result::kFailed, "throws that failed: " + list_of(failed)};
}

// How many of the throws that succeeded before must be lost, and none gained, for the gate to fail;
// empty if not even all of them are enough.
std::optional<std::int64_t> losses_that_fail(const PairedCounts& counts, const GateRules& rules) {
  const std::int64_t successes = counts.both + counts.only_first;
  const auto fails = [&](std::int64_t lost) {
    const PairedCounts then = {successes - lost, lost, 0, counts.total() - successes};
    return judge_drop(then, rules.margin, rules.confidence).fell;
  };
  if (successes == 0 || !fails(successes)) return std::nullopt;
  std::int64_t passes = 0, least = successes;
  while (least - passes > 1) {
    const std::int64_t lost = passes + (least - passes) / 2;
    (fails(lost) ? least : passes) = lost;
  }
  return least;
}

// No throw may escape the comparison. A throw that grazes may hit on one kind of machine only.
GateCheck throws_are_the_same(const Comparison& comparison, bool same_machine) {
  const std::string name = "same throws";
  if (!comparison.paired || !comparison.differing.empty()) {
    return {name, Result::kFailed, "these are not the baseline's throws"};
  }
  std::string reason;
  const auto add = [&reason](const std::string& what, const std::vector<int>& throws) {
    if (throws.empty()) return;
    reason += (reason.empty() ? "throws " : "; throws ") + what + ": " + list_of(throws);
  };
  add("of the baseline only", comparison.only_first);
  add("of this campaign only", comparison.only_second);
  add("that would have missed, or that nobody could fly, in one of the two only",
      comparison.counts_differ);
  if (reason.empty()) return {name, Result::kPassed, ""};
  const bool all_there = comparison.only_first.empty() && comparison.only_second.empty();
  if (all_there && !same_machine) return {name, Result::kPassed, reason};
  return {name, Result::kFailed, reason + " (if this is meant, --update makes a new baseline)"};
}

GateCheck rate_can_fall(const Comparison& comparison, const GateRules& rules, bool same_machine) {
  const std::string name = "enough throws";
  const auto lost = losses_that_fail(comparison.counts, rules);
  const std::string counted = std::to_string(comparison.counts.total()) + " throws";
  if (lost) {
    return {name, Result::kPassed,
            "with " + counted + " the success rate fails from " + std::to_string(*lost) +
                " lost on if none is gained"};
  }
  const bool bytes_can =
      rules.must_equal != "nothing" && same_machine && comparison.counts.total() > 0;
  return {name, bytes_can ? Result::kLeftOut : Result::kFailed,
          "with " + counted + " the success rate could never fail" +
              (bytes_can ? ", only the bytes (" + rules.must_equal + ") could" : "")};
}

GateCheck rate_holds(const Comparison& comparison, const GateRules& rules) {
  const DropVerdict drop = judge_drop(comparison.counts, rules.margin, rules.confidence);
  std::string text;
  if (drop.fell) {
    text = formatted(
        "it fell by %.3f, with a confidence of %g by more than the margin of %g (p = %.2g)",
        drop.drop, rules.confidence, rules.margin, drop.p_fell);
  } else if (drop.kept) {
    text = formatted("with a confidence of %g not lower by the margin of %g (p = %.2g)",
                     rules.confidence, rules.margin, drop.p_kept);
  } else {
    text = formatted(
        "no proof that it fell by more than %g, nor that it did not, with so few throws (%lld)",
        rules.margin, static_cast<long long>(comparison.counts.total()));
  }
  return {"success rate", drop.fell ? Result::kFailed : Result::kPassed, text};
}

// Adds a row's first change: of what is drawn and what becomes of it when nobody dodges
// (`physics_only`), or of any column.
void add_changed_rows(const CsvTable& before, const CsvTable& after, bool physics_only,
                      std::vector<std::string>& changed) {
  if (before.rows() != after.rows()) {
    changed.push_back(before.name() + " had " + std::to_string(before.rows()) + " rows, has " +
                      std::to_string(after.rows()));
  }
  const auto counts = [physics_only](const std::string& column) {
    return !physics_only || column.starts_with("none_") || is_drawn(column);
  };
  std::vector<std::string> columns;  // of both
  for (const std::string& column : before.columns()) {
    if (!counts(column)) continue;
    if (after.has(column)) {
      columns.push_back(column);
    } else {
      changed.push_back(before.name() + " had a column " + column);
    }
  }
  for (const std::string& column : after.columns()) {
    if (counts(column) && !before.has(column)) {
      changed.push_back(before.name() + " had no column " + column);
    }
  }
  const auto value = [](const std::string& text) { return text.empty() ? "empty" : text; };
  for (std::size_t row = 0; row < std::min(before.rows(), after.rows()); ++row) {
    for (const std::string& column : columns) {
      const std::string &was = before.at(row, column), &is = after.at(row, column);
      if (was == is) continue;
      changed.push_back(before.name() + ": throw " + before.at(row, "throw") + " " + column +
                        " was " + value(was) + ", is " + value(is));
      break;
    }
  }
}

GateCheck bytes_equal(const CampaignTables& before, const CampaignTables& after,
                      const GateRules& rules) {
  const bool physics_only = rules.must_equal == "physics";
  std::vector<std::string> changed;
  add_changed_rows(before.throws, after.throws, physics_only, changed);
  if (before.objects && after.objects) {
    add_changed_rows(*before.objects, *after.objects, physics_only, changed);
  }
  GateCheck check{physics_only ? "same bytes of the physics" : "same bytes", Result::kPassed, ""};
  if (changed.empty()) return check;
  return {check.name, Result::kFailed,
          std::to_string(changed.size()) + " rows or columns changed: " + list_of(changed)};
}

}  // namespace

bool GateVerdict::passed() const { return !contains(checks, Result::kFailed, &GateCheck::result); }

GateVerdict judge(const Baseline& baseline, const CampaignTables& flown,
                  const std::string& machine_kind, const GateRules& rules) {
  GateVerdict verdict;
  verdict.comparison = compare(outcomes(baseline.tables), outcomes(flown));
  verdict.checks.push_back(every_throw_flew(flown.throws));
  const bool same_machine = machine_kind == baseline.machine_kind;
  verdict.checks.push_back(throws_are_the_same(verdict.comparison, same_machine));
  verdict.checks.push_back(rate_can_fall(verdict.comparison, rules, same_machine));
  verdict.checks.push_back(rate_holds(verdict.comparison, rules));
  if (rules.must_equal == "nothing") return verdict;
  GateCheck bytes = bytes_equal(baseline.tables, flown, rules);
  if (!same_machine) {
    const std::string changes = bytes.reason.empty() ? "no row changed" : bytes.reason;
    bytes.result = Result::kLeftOut;
    bytes.reason = "the baseline is of another kind of machine, or of other libraries; " + changes;
  }
  verdict.checks.push_back(std::move(bytes));
  return verdict;
}

bool is_junit(const std::string& text) { return text.starts_with(kJunitHead); }

std::string junit_xml(const GateVerdict& verdict, const std::string& name,
                      const std::string& text) {
  std::string cases;
  int failed = 0, left_out = 0;
  for (const GateCheck& check : verdict.checks) {
    cases += "    <testcase classname=\"" + markup_escaped(name) + "\" name=\"" +
             markup_escaped(check.name) + "\"";
    if (check.result == Result::kFailed) {
      ++failed;
      cases += "><failure message=\"" + markup_escaped(check.reason) + "\"/></testcase>\n";
    } else if (check.result == Result::kLeftOut) {
      ++left_out;
      cases += "><skipped message=\"" + markup_escaped(check.reason) + "\"/></testcase>\n";
    } else {
      cases += "/>\n";
    }
  }
  const std::string counts = " tests=\"" + std::to_string(verdict.checks.size()) +
                             "\" failures=\"" + std::to_string(failed) + "\" skipped=\"" +
                             std::to_string(left_out) + "\"";
  return kJunitHead + counts + ">\n  <testsuite name=\"" + markup_escaped(name) + "\"" + counts +
         ">\n" + cases + "    <system-out>" + markup_escaped(text) +
         "</system-out>\n  </testsuite>\n</testsuites>\n";
}

}  // namespace dodgesim
