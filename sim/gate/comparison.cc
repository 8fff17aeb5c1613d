#include "sim/gate/comparison.h"

#include <array>
#include <cstdio>
#include <map>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

bool yes(const CsvTable& table, std::size_t row, const std::string& column) {
  return table.at(row, column) == "1";
}

std::string rounded(const std::string& number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", std::atof(number.c_str()));
  return text;
}

std::string label_of(const CsvTable& table, std::size_t row) {
  const std::string& object = table.at(row, "object");
  if (object.empty()) return "quiet flight";
  return rounded(table.at(row, "size_m")) + " m " + object + ", " +
         rounded(table.at(row, "speed_mps")) + " m/s from " + rounded(table.at(row, "distance_m")) +
         " m";
}

ThrowOutcome outcome(const CsvTable& table, std::size_t row) {
  ThrowOutcome out;
  out.number = std::atoi(table.at(row, "throw").c_str());
  if (table.has("sweep")) out.sweep = std::atoi(table.at(row, "sweep").c_str());
  out.label = label_of(table, row);
  for (const std::string& column : drawn_columns()) out.draw += table.at(row, column) + ",";
  const bool thrown = !table.at(row, "object").empty();
  const bool judged = table.at(row, "none_status") == "ok";  // it is known whether it would hit
  out.counts = !thrown || !judged || yes(table, row, "none_hit");
  if (table.at(row, "flown_status") != "ok") {
    out.what = "error: " + table.at(row, "flown_error");
  } else if (yes(table, row, "flown_hit")) {
    out.what = "hit";
  } else if (yes(table, row, "flown_crashed")) {
    out.what = "crashed";
  } else if (!thrown && yes(table, row, "evaded")) {
    out.what = "evaded nothing";
  } else {
    out.what = thrown ? "dodged" : "quiet";
    out.success = !thrown || judged;
  }
  return out;
}

bool same_throws(const std::vector<ThrowOutcome>& first,
                 const std::map<int, const ThrowOutcome*>& second) {
  bool any = false;
  for (const ThrowOutcome& a : first) {
    const auto b = second.find(a.number);
    if (b == second.end()) continue;
    if (b->second->draw != a.draw) return false;
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
  if (a.counts != b.counts) ++sum.counts_differ;
  if (!a.counts || !b.counts) return;
  sum.counts.add(a.success, b.success);
  if (a.success == b.success) return;
  (a.success ? sum.lost : sum.gained).push_back({a.number, a.label, a.what, b.what});
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 200> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string rate_line(const std::string& name, const Proportion& rate) {
  const Interval interval = wilson(rate.successes, rate.trials);
  const double share =
      rate.trials == 0 ? 0 : static_cast<double>(rate.successes) / static_cast<double>(rate.trials);
  return name + formatted(": %lld of %lld succeeded (%.3f, %.3f to %.3f)\n",
                          static_cast<long long>(rate.successes),
                          static_cast<long long>(rate.trials), share, interval.lo, interval.hi);
}

double share_of(const Proportion& p) {
  return p.trials == 0 ? 0 : static_cast<double>(p.successes) / static_cast<double>(p.trials);
}

}  // namespace

const std::vector<std::string>& drawn_columns() {
  static const std::vector<std::string> columns = {
      "object",       "size_m",         "speed_mps",       "distance_m",
      "bearing_deg",  "aim_offset_m_0", "aim_offset_m_1",  "spin_radps_0",
      "spin_radps_1", "spin_radps_2",   "launch_height_m", "launch_us"};
  return columns;
}

std::vector<ThrowOutcome> outcomes(const CsvTable& throws) {
  std::vector<ThrowOutcome> all;
  for (std::size_t row = 0; row < throws.rows(); ++row) all.push_back(outcome(throws, row));
  return all;
}

Comparison compare(const std::vector<ThrowOutcome>& first,
                   const std::vector<ThrowOutcome>& second) {
  std::map<int, const ThrowOutcome*> by_number;
  for (const ThrowOutcome& b : second) by_number[b.number] = &b;
  Comparison sum;
  sum.paired = same_throws(first, by_number);
  if (!sum.paired) {
    sum.first = proportion(first);
    sum.second = proportion(second);
    return sum;
  }
  for (const ThrowOutcome& a : first) {
    const auto b = by_number.find(a.number);
    if (b != by_number.end()) add_pair(a, *b->second, sum);
  }
  sum.unmatched = static_cast<int>(first.size() + second.size()) - 2 * sum.throws;
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
  if (c.unmatched > 0) {
    text += formatted("%d throws are in one campaign only and are left out\n", c.unmatched);
  }
  if (c.counts_differ > 0) {
    text += formatted("%d throws would have hit in one campaign only and are left out\n",
                      c.counts_differ);
  }
  return text;
}

}  // namespace dodgesim
