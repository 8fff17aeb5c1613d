// The formats of statistics_table.h.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "sim/base/formatted.h"
#include "sim/base/numbers.h"
#include "sim/config/pilot.h"
#include "sim/files/csv.h"
#include "sim/files/json.h"
#include "sim/files/text_table.h"
#include "sim/tables/statistics_table.h"

namespace dodgesim {

namespace {

using Cells = std::vector<std::string>;

std::string rounded(double value) { return formatted("%.3g", value); }

std::string sample_text(const Measured& sample) {
  if (sample.count() == 0) return "-";
  return rounded(sample.quantile(0.5)->value) + " (" + rounded(sample.quantile(0.1)->value) +
         " to " + rounded(sample.quantile(0.9)->value) + "), " + std::to_string(sample.count());
}

// Dodged by each pilot of those that would have hit; for none, would have hit.
void add_dodged(const StatisticsTable& table, TextTable& text) {
  const std::string& first = table.rows.front().statistics.flown().pilot;
  const bool one_pilot = std::ranges::all_of(
      table.rows, [&](const auto& row) { return row.statistics.flown().pilot == first; });
  std::map<Role, std::string> heads = {{Role::kFlown, (one_pilot ? first + ": " : "") + "dodged"},
                                       {Role::kOracle, "oracle: dodged"},
                                       {Role::kNone, "none: would have hit"}};
  for (const Role role : shown_pilots(table)) {
    text.head.push_back(heads[role]);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      text.rows[i].push_back(tally_text(table.rows[i].statistics.by(role).tally, role));
    }
  }
}

TextTable rates_of(const StatisticsTable& table, bool with_dodged) {
  TextTable text;
  text.head = table.keys;
  for (const StatisticsTable::Row& row : table.rows) text.rows.push_back(row.values);
  if (with_dodged) add_dodged(table, text);
  for (const char* name : {"hit or crashed", "detected, of those in view", "false alarms"}) {
    text.head.push_back(name);
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const ThrowStatistics& statistics = table.rows[i].statistics;
    for (const Rate& rate :
         {statistics.flown().tally.collisions, statistics.detected, statistics.false_alarms}) {
      text.rows[i].push_back(rate_text(rate));
    }
  }
  return text;
}

TextTable samples_of(const StatisticsTable& table) {
  TextTable text;
  text.head = table.keys;
  for (const NamedSample& named : kSamples) text.head.push_back(named.name);
  text.head.push_back("clearance_m");
  for (const StatisticsTable::Row& row : table.rows) {
    Cells& cells = text.rows.emplace_back(row.values);
    for (const NamedSample& named : kSamples) {
      cells.push_back(sample_text(row.statistics.*named.sample));
    }
    cells.push_back(sample_text(row.statistics.flown().clearance_m));
  }
  return text;
}

// "<", ">" and "|" are other signs in LaTeX's default font encoding, and "[" or "*" at the start of
// a row would belong to the end of the row before.
std::string latex_escaped(const std::string& text) {
  static const std::map<char, std::string> kEscapes = {
      {'\\', "\\textbackslash{}"}, {'~', "\\~{}"},       {'^', "\\^{}"}, {'<', "\\textless{}"},
      {'>', "\\textgreater{}"},    {'|', "\\textbar{}"}, {'[', "{[}"},   {'*', "{*}"}};
  std::string escaped;
  for (const char c : text) {
    const auto at = kEscapes.find(c);
    if (at != kEscapes.end()) {
      escaped += at->second;
      continue;
    }
    if (std::strchr("&%$#_{}", c) != nullptr) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string latex_row(const Cells& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    line += (line.empty() ? "  " : " & ") + (cell.empty() ? "{}" : latex_escaped(cell));
  }
  return line + " \\\\\n";
}

std::string latex_of(const TextTable& table) {
  std::string text = "\\begin{tabular}{" + std::string(table.head.size(), 'l') + "}\n  \\toprule\n";
  text += latex_row(table.head) + "  \\midrule\n";
  for (const Cells& row : table.rows) text += latex_row(row);
  return text + "  \\bottomrule\n\\end{tabular}\n";
}

std::string cell_of(std::optional<double> value) {
  return value && std::isfinite(*value) ? to_text(*value) : "";
}

class StatisticsLine : public CsvLine {
 public:
  void text(const std::string& name, const std::string& value) { add(name, csv_cell(value)); }
  void count(const std::string& name, std::int64_t value) { add(name, std::to_string(value)); }
  void rate(const std::string& name, const Rate& rate) {
    add(name, cell_of(rate.value()));
    add(name + "_lo", rate.has_interval() ? cell_of(rate.interval().lo) : "");
    add(name + "_hi", rate.has_interval() ? cell_of(rate.interval().hi) : "");
  }
  void sample(const std::string& name, const Measured& sample) {
    count(name + "_n", static_cast<std::int64_t>(sample.count()));
    const auto median = sample.quantile(0.5);
    const auto value = [&](double share) -> std::optional<double> {
      const auto quantile = sample.quantile(share);
      return quantile ? std::optional(quantile->value) : std::nullopt;
    };
    add(name + "_q10", cell_of(value(0.1)));
    add(name + "_q50", cell_of(value(0.5)));
    add(name + "_q50_lo", median ? cell_of(median->interval.lo) : "");
    add(name + "_q50_hi", median ? cell_of(median->interval.hi) : "");
    add(name + "_q90", cell_of(value(0.9)));
  }
};

// Who has a row of its own; a pilot none or an oracle that flew is not its own reference.
std::vector<Role> named_pilots(const StatisticsTable& table, const StatisticsTable::Row& row) {
  std::vector<Role> pilots = shown_pilots(table);
  std::erase_if(pilots, [&](Role role) {
    return role != Role::kFlown && row.statistics.by(role).pilot == row.statistics.flown().pilot;
  });
  return pilots;
}

// Of the pilot none, of the throws that are known to have hit it.
Rate dodged_by(const PilotStatistics& of) {
  Rate rate = of.tally.success();
  if (of.pilot == kNoPilot) rate.of = of.tally.hit_undisturbed.count;
  return rate;
}

// What only the flown pilot has is empty for the others.
StatisticsLine line_of(const StatisticsTable& table, const StatisticsTable::Row& row,
                       const PilotStatistics& of) {
  const bool flown = &of == &row.statistics.flown();
  const ThrowStatistics nothing;
  const ThrowStatistics& perception = flown ? row.statistics : nothing;
  StatisticsLine csv;
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    // The next column is that of the pilot who flew.
    const std::string& key = table.keys[i];
    csv.text(key == "pilot" ? "sweep_pilot" : key, row.values[i]);
  }
  csv.text("pilot", of.pilot);
  csv.count("throws", of.tally.throws);
  const Rate dodged = dodged_by(of);
  csv.count("would_have_hit", dodged.of);
  csv.count("dodged", dodged.count);
  csv.rate("rate", dodged);
  csv.text("rate_interval", dodged.interval_name());
  csv.rate("would_have_hit_rate", of.tally.hit_undisturbed);
  csv.count("errors", of.tally.errors);
  csv.count("flights", of.tally.collisions.of);
  csv.count("collisions", of.tally.collisions.count);
  csv.rate("collision_rate", of.tally.collisions);
  csv.sample("clearance_m", of.clearance_m);
  const auto count_of_flown = [&](const std::string& name, std::int64_t count) {
    csv.text(name, flown ? std::to_string(count) : "");
  };
  count_of_flown("in_view", perception.detected.of);
  count_of_flown("detected", perception.detected.count);
  csv.rate("detection_rate", perception.detected);
  count_of_flown("false_alarms", perception.false_alarms.count);
  csv.rate("false_alarm_rate", perception.false_alarms);
  for (const NamedSample& named : kSamples) csv.sample(named.name, perception.*named.sample);
  return csv;
}

Json json_number(std::optional<double> value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json json_of(const Rate& rate) {
  return {{"count", rate.count},
          {"of", rate.of},
          {"rate", json_number(rate.value())},
          {"lo", rate.has_interval() ? Json(rate.interval().lo) : Json(nullptr)},
          {"hi", rate.has_interval() ? Json(rate.interval().hi) : Json(nullptr)},
          {"interval", rate.interval_name()}};
}

Json json_of(const Measured& sample) {
  Json json = {{"count", sample.count()}};
  for (const auto& [name, share] : {std::pair{"q10", 0.1}, {"q50", 0.5}, {"q90", 0.9}}) {
    const auto quantile = sample.quantile(share);
    json[name] = quantile ? Json{{"value", json_number(quantile->value)},
                                 {"lo", json_number(quantile->interval.lo)},
                                 {"hi", json_number(quantile->interval.hi)}}
                          : Json(nullptr);
  }
  return json;
}

Json json_of(const StatisticsTable& table, const StatisticsTable::Row& row) {
  Json json = Json::object();
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    const std::optional<double> number = as_number(row.values[i]);
    json[table.keys[i]] = number ? Json(*number) : Json(row.values[i]);
  }
  for (const Role role : named_pilots(table, row)) {
    const PilotStatistics& of = row.statistics.by(role);
    json["pilots"].push_back({{"pilot", of.pilot},
                              {"throws", of.tally.throws},
                              {"would_have_hit_rate", json_of(of.tally.hit_undisturbed)},
                              {"dodged", json_of(dodged_by(of))},
                              {"collisions", json_of(of.tally.collisions)},
                              {"errors", of.tally.errors},
                              {"clearance_m", json_of(of.clearance_m)}});
  }
  json["detected"] = json_of(row.statistics.detected);
  json["false_alarms"] = json_of(row.statistics.false_alarms);
  for (const NamedSample& named : kSamples) {
    json[named.name] = json_of(row.statistics.*named.sample);
  }
  json["causes"] = row.statistics.causes;
  return json;
}

}  // namespace

std::string rates_to_markdown(const StatisticsTable& table, bool with_dodged) {
  return rates_of(table, with_dodged).to_markdown();
}

std::string to_markdown(const StatisticsTable& table, bool with_dodged) {
  return rates_to_markdown(table, with_dodged) + "\n" + samples_of(table).to_markdown();
}

std::string to_latex(const StatisticsTable& table) {
  return latex_of(rates_of(table, true)) + "\n" + latex_of(samples_of(table));
}

std::string to_csv(const StatisticsTable& table) {
  std::string text;
  for (const StatisticsTable::Row& row : table.rows) {
    for (const Role role : named_pilots(table, row)) {
      const StatisticsLine line = line_of(table, row, row.statistics.by(role));
      if (text.empty()) text = line.header();
      text += line.row();
    }
  }
  return text;
}

std::string to_json(const StatisticsTable& table) {
  Json rows = Json::array();
  for (const StatisticsTable::Row& row : table.rows) rows.push_back(json_of(table, row));
  return to_text(rows, 2) + "\n";
}

}  // namespace dodgesim
