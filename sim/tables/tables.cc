#include "sim/tables/tables.h"

#include <algorithm>
#include <iterator>

#include "sim/base/joined.h"
#include "sim/config/expand.h"
#include "sim/files/markup.h"
#include "sim/files/text_table.h"
#include "sim/outcome/collision_cause.h"
#include "sim/tables/axis.h"
#include "sim/tables/statistics_table.h"

namespace dodgesim {

namespace {

const std::vector<std::string> kKeys = {"size_m", "distance_m", "speed_mps"};

// Under which key the tables show a key of the grid: throw.size_m is size_m.
std::string shown_key(const std::string& key) {
  const auto at =
      std::ranges::find_if(kKeys, [&](const std::string& k) { return "throw." + k == key; });
  return at == kKeys.end() ? key : *at;
}

// Rows told apart by some of the keys only, with "all" for the others; the row of all throws, and
// rows that are there already, are left out.
void append(const Part& part, const std::vector<Axis>& by, StatisticsTable& table) {
  StatisticsTable grouped = group_by(part, by);
  grouped.rows.pop_back();
  for (StatisticsTable::Row& row : grouped.rows) {
    std::vector<std::string> values(table.keys.size(), "all");
    for (std::size_t i = 0; i < by.size(); ++i) {
      const auto at = std::ranges::find(table.keys, shown_key(by[i].name()));
      values[static_cast<std::size_t>(at - table.keys.begin())] = row.values[i];
    }
    if (find_row(table, values) != nullptr) continue;
    table.rows.push_back({std::move(values), std::move(row.statistics)});
  }
}

struct TableAxes {
  Axis size, distance, speed;
  std::vector<Axis> grid;
};

// Every cell that the tables of a part show.
StatisticsTable all_cells(const Part& part, const TableAxes& axes) {
  StatisticsTable table;
  table.keys = kKeys;
  for (const Axis& axis : axes.grid) {
    const std::string key = shown_key(axis.name());
    if (key == axis.name()) table.keys.push_back(key);
  }
  append(part, {axes.size, axes.distance}, table);
  append(part, {axes.size}, table);
  append(part, {axes.distance}, table);
  append(part, {axes.speed}, table);
  append(part, axes.grid, table);
  table.rows.push_back({std::vector<std::string>(table.keys.size(), "all"), statistics_of(part)});
  return table;
}

std::string heading(const StatisticsTable& table, Role role) {
  if (role == Role::kNone) return "none: would have hit";
  return table.rows.back().statistics.by(role).pilot;
}

// Of the pilot, where the row has these `values` of kKeys and is not told apart by other keys.
std::string cell(const StatisticsTable& table, std::vector<std::string> values, Role role) {
  values.resize(table.keys.size(), "all");
  const StatisticsTable::Row* const row = find_row(table, values);
  return tally_text(row == nullptr ? Tally{} : row->statistics.by(role).tally, role);
}

TextTable by_size_and_distance(const TableAxes& axes, const StatisticsTable& table) {
  TextTable text;
  text.head = {"size", "pilot"};
  for (const std::string& distance : axes.distance.values()) text.head.push_back(distance + " m");
  text.head.push_back("all distances");
  std::vector<std::string> sizes = axes.size.values(), distances = axes.distance.values();
  sizes.push_back("all");
  distances.push_back("all");
  for (const std::string& size : sizes) {
    for (const Role role : shown_pilots(table)) {
      auto& cells = text.rows.emplace_back();
      cells = {size == "all" ? size : size + " m", heading(table, role)};
      for (const std::string& distance : distances) {
        cells.push_back(cell(table, {size, distance, "all"}, role));
      }
    }
  }
  return text;
}

TextTable by_speed(const TableAxes& axes, const StatisticsTable& table) {
  TextTable text;
  text.head = {"speed"};
  for (const Role role : shown_pilots(table)) text.head.push_back(heading(table, role));
  for (const std::string& speed : axes.speed.values()) {
    auto& cells = text.rows.emplace_back();
    cells = {speed + " m/s"};
    for (const Role role : shown_pilots(table)) {
      cells.push_back(cell(table, {"all", "all", speed}, role));
    }
  }
  return text;
}

// The rows that are told apart by nothing but the size.
StatisticsTable by_size(const StatisticsTable& table) {
  StatisticsTable sizes;
  sizes.keys = {"size_m"};
  for (const StatisticsTable::Row& row : table.rows) {
    if (std::all_of(row.values.begin() + 1, row.values.end(),
                    [](const std::string& value) { return value == "all"; })) {
      sizes.rows.push_back({{row.values[0]}, row.statistics});
    }
  }
  return sizes;
}

// The first throws of a cause.
std::string numbers_of(const Part& part, const std::string& cause) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> numbers;
  for (const ThrowResult* result : part.results) {
    if (result->cause == cause) numbers.push_back(std::to_string(result->index));
  }
  const bool more = numbers.size() > kMost;
  if (more) numbers.resize(kMost);
  return joined(numbers) + (more ? ", ..." : "");
}

TextTable causes_of(const Part& part, const std::map<std::string, int>& causes) {
  TextTable text;
  text.head = {"cause", "throws", "throw numbers"};
  for (const CollisionCause cause : kCollisionCauses) {
    const std::string name = to_text(cause);
    const auto at = causes.find(name);
    if (at == causes.end()) continue;
    text.rows.push_back({name, std::to_string(at->second), numbers_of(part, name)});
  }
  return text;
}

std::string errors_of(const Part& part) {
  std::string errors, of_nobody;
  int failed = 0, not_flown = 0;
  for (const ThrowResult* result : part.results) {
    const std::string name = "- throw " + std::to_string(result->index);
    if (result->nobody_could_fly()) {
      ++not_flown;
      of_nobody += name + ": " + result->flown.error + "\n";
      continue;
    }
    for (const auto& [flight, who] : failed_flights(*result, part.pilot)) {
      ++failed;
      errors += name + ", pilot " + who + ": " + flight->error + "\n";
    }
  }
  std::string text;
  if (not_flown > 0) {
    text += count_text(not_flown, "throw") +
            " could not be flown, whoever the pilot, which no rate counts:\n\n" + of_nobody + "\n";
  }
  if (failed > 0) {
    text += count_text(failed, "flight") + " failed, which is no success:\n\n" + errors + "\n";
  }
  return text.empty() ? "" : "## Errors\n\n" + text;
}

std::string landings_of(const Part& part) {
  int began = 0, landed = 0, gave_up = 0;
  for (const ThrowResult* result : part.results) {
    if (!result->landing_us) continue;
    ++began;
    landed += result->landed_us ? 1 : 0;
    gave_up += result->thrown() && result->none.hit && result->gave_up() ? 1 : 0;
  }
  if (began == 0) return "";
  std::string text = "Emergency landings: " + part.pilot + " began one in " +
                     count_text(began, "flight") + " and touched down in " +
                     std::to_string(landed) + ".";
  if (gave_up > 0) {
    text += " " + count_text(gave_up, "throw") +
            " that would have hit came later and count as not dodged.";
  }
  return text + "\n\n";
}

// What a rate over the throws that would have hit does not show.
std::string asides(const Part& part) {
  int would_miss = 0, miss_evaded = 0, walked_into = 0, crashed = 0, crashed_undisturbed = 0;
  int after_room = 0, unjudged = 0, elsewhere = 0;
  Rate quiet;
  for (const ThrowResult* result : part.results) {
    unjudged += result->thrown() && !result->none.ok() && !result->nobody_could_fly() ? 1 : 0;
    after_room += result->none_after_room ? 1 : 0;
    if (!result->flown.ok()) continue;
    elsewhere += result->dodged() && !result->evaded ? 1 : 0;
    if (!result->thrown()) {
      quiet.add(result->evaded);
      crashed += result->flown.crashed ? 1 : 0;
    } else if (result->none.ok() && !result->none.hit) {
      crashed_undisturbed += result->none.crashed ? 1 : 0;
      ++would_miss;
      miss_evaded += result->evaded ? 1 : 0;
      walked_into += result->flown.hit ? 1 : 0;
    }
  }
  std::string text;
  if (quiet.of > 0) {
    text += "False alarms: " + part.pilot + " evaded in " + rate_text(quiet) +
            " flights in which nobody threw.\n\n";
    if (crashed > 0) {
      text += "It crashed in " + count_text(crashed, "flight") + " of these.\n\n";
    }
  }
  if (unjudged > 0 && part.pilot != kNoPilot) {
    text += "Whether " + count_text(unjudged, "throw") +
            " would have hit is not known, as the flight in which nobody dodges failed or was not "
            "flown: counted as if so, and as not dodged.\n\n";
  }
  if (elsewhere > 0) {
    text += "Of the throws that count as dodged " + std::to_string(elsewhere) + " missed " +
            part.pilot + " without an evasion: it was not where the throw was aimed.\n\n";
  }
  if (would_miss > 0) {
    text += "Of " + count_text(would_miss, "throw") + " that would have missed, " + part.pilot +
            " evaded " + std::to_string(miss_evaded) + " and was hit by " +
            std::to_string(walked_into) + ".\n\n";
  }
  if (crashed_undisturbed > 0) {
    text +=
        "In " + count_text(crashed_undisturbed, "throw") +
        " of these the vehicle crashed with nobody dodging: it does not fly well enough to be " +
        "hit.\n\n";
  }
  if (after_room > 0) {
    text +=
        "In " + count_text(after_room, "throw") +
        " an object had touched the room when it came nearest (pilot none): it flew as nobody " +
        "threw it.\n\n";
  }
  return text + landings_of(part) + errors_of(part);
}

std::string section(const std::string& title, const std::string& text) {
  return "## " + title + "\n\n" + text + "\n";
}

std::string markdown_of(const Part& part, const TableAxes& axes, const StatisticsTable& table) {
  const ThrowStatistics& all = table.rows.back().statistics;
  std::string text;
  if (!part.values.empty()) text += "# " + markdown_escaped(label(part.values)) + "\n\n";
  const bool anything_thrown = std::ranges::any_of(part.results, &ThrowResult::thrown);
  if (anything_thrown) {
    text += "Dodged: " + rate_text(all.flown().tally.success()) + "\n\n";
    text += section("By size and distance", by_size_and_distance(axes, table).to_markdown());
    text += section("By speed", by_speed(axes, table).to_markdown());
    text += section("Collisions, detections and latencies",
                    "All throws. Median (10 % to 90 % quantile), count.\n\n" +
                        to_markdown(by_size(table), false));
  }
  if (!axes.grid.empty()) {
    text += section("By cell of the grid", rates_to_markdown(group_by(part, axes.grid)));
  }
  if (!all.causes.empty()) {
    text += section("Why it was hit or crashed", causes_of(part, all.causes).to_markdown());
  }
  return text + asides(part);
}

std::string head_of(const LoadedCampaign& campaign) {
  const std::vector<ThrowResult>& results = campaign.results;
  const bool thrown = std::ranges::any_of(results, &ThrowResult::thrown);
  std::string text =
      "# " + markdown_escaped(campaign.scenario.name) + "\n\n" +
      count_text(static_cast<std::int64_t>(results.size()), thrown ? "throw" : "flight") + ", " +
      pilots_of(campaign.scenario) + ".";
  if (thrown) {
    text +=
        " Cells: dodged / would have hit (rate, 95 % Wilson interval); for the "
        "pilot none: would have hit / throws.";
  }
  if (std::ranges::any_of(results, [](const ThrowResult& r) { return r.objects > 1; })) {
    text += " Of several objects a throw, size, distance, speed and so on are those of the first.";
  }
  text += "\n\n";
  const int planned = throw_count(campaign.scenario);
  if (static_cast<int>(results.size()) < planned && !campaign.ended_early()) {
    text += "Not all of the scenario's " + std::to_string(planned) +
            ": a shard, or a campaign that was stopped.\n\n";
  }
  if (campaign.stop) text += campaign.stop->text() + "\n\n";
  if (const std::string losses = campaign.losses(); !losses.empty()) text += losses + "\n\n";
  if (campaign.ended_early()) {
    text +=
        "The intervals of single rows are approximate: what was seen decided how many throws "
        "there are.\n\n";
  }
  return text;
}

}  // namespace

Tables make_tables(const LoadedCampaign& campaign) {
  const std::vector<ThrowResult>& results = campaign.results;
  const TableAxes axes = {Axis("size_m", results), Axis("distance_m", results),
                          Axis("speed_mps", results), grid_axes(results)};
  const std::vector<Part> parts = parts_of(campaign);
  const std::string head = head_of(campaign);
  Tables tables;
  tables.markdown = head;
  StatisticsTable all;
  for (const Part& part : parts) {
    const StatisticsTable table = all_cells(part, axes);
    tables.markdown += markdown_of(part, axes, table);
    StatisticsTable swept = of_sweep(part, table);
    all.keys = swept.keys;
    std::move(swept.rows.begin(), swept.rows.end(), std::back_inserter(all.rows));
  }
  tables.csv = to_csv(all);
  if (parts.size() <= 1) {
    tables.overview = tables.markdown;
  } else {
    tables.overview = head + rates_to_markdown(group_by(parts, axes.grid)) +
                      "\ntable.md has more of each value of the sweep.\n\n";
  }
  return tables;
}

}  // namespace dodgesim
