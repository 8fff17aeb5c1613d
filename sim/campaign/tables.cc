#include "sim/campaign/tables.h"

#include <algorithm>
#include <iterator>

#include "sim/campaign/axis.h"
#include "sim/campaign/statistics_table.h"
#include "sim/campaign/text_table.h"
#include "sim/config/expand.h"
#include "sim/files/markup.h"
#include "sim/outcome/collision_cause.h"

namespace dodgesim {

namespace {

const std::vector<std::string> kKeys = {"size_m", "distance_m", "speed_mps"};

// Under which key the tables show a key of the grid: throw.size_m is size_m.
std::string shown_key(const std::string& key) {
  const auto at = std::find_if(kKeys.begin(), kKeys.end(),
                               [&](const std::string& k) { return "throw." + k == key; });
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
      const auto at = std::find(table.keys.begin(), table.keys.end(), shown_key(by[i].name()));
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

class MarkdownWriter {
 public:
  MarkdownWriter(const Part& part, const TableAxes& axes, const StatisticsTable& table)
      : part_(part), axes_(axes), table_(table), pilots_(shown_pilots(table)) {}

  void by_size_and_distance() {
    const std::vector<std::string>& distances = axes_.distance.values();
    text_ += "## By size and distance\n\n| size | pilot |";
    for (const std::string& distance : distances) text_ += " " + distance + " m |";
    text_ += " all distances |\n|---|---|";
    for (std::size_t i = 0; i <= distances.size(); ++i) text_ += "---|";
    text_ += "\n";
    for (const std::string& size : axes_.size.values()) size_rows(size, distances);
    size_rows("all", distances);
    text_ += "\n";
  }

  void by_speed() {
    text_ += "## By speed\n\n| speed |";
    for (const Role role : pilots_) text_ += " " + heading(role) + " |";
    text_ += "\n|---|";
    for (std::size_t i = 0; i < pilots_.size(); ++i) text_ += "---|";
    text_ += "\n";
    for (const std::string& speed : axes_.speed.values()) {
      text_ += "| " + speed + " m/s |";
      for (const Role role : pilots_) {
        text_ += " " + cell({"all", "all", speed}, role) + " |";
      }
      text_ += "\n";
    }
    text_ += "\n";
  }

  void by_cell() {
    if (axes_.grid.empty()) return;
    text_ += "## By cell of the grid\n\n" + rates_to_markdown(group_by(part_, axes_.grid)) + "\n";
  }

  // What the pilot saw and did, by size.
  void perception() {
    StatisticsTable by_size;
    by_size.keys = {"size_m"};
    for (const StatisticsTable::Row& row : table_.rows) {
      if (std::all_of(row.values.begin() + 1, row.values.end(),
                      [](const std::string& value) { return value == "all"; })) {
        by_size.rows.push_back({{row.values[0]}, row.statistics});
      }
    }
    text_ +=
        "## Collisions, detections and latencies\n\nAll throws. Median (10 % to 90 % "
        "quantile), count.\n\n" +
        to_markdown(by_size, false) + "\n";
  }

  void causes() {
    const std::map<std::string, int>& causes = all().causes;
    if (causes.empty()) return;
    text_ += "## Why it was hit or crashed\n\n| cause | throws | throw numbers |\n|---|---|---|\n";
    for (const CollisionCause cause : kCollisionCauses) {
      const std::string name = to_text(cause);
      const auto at = causes.find(name);
      if (at == causes.end()) continue;
      text_ += "| " + name + " | " + std::to_string(at->second) + " | " + numbers(name) + " |\n";
    }
    text_ += "\n";
  }

  std::string take() { return std::move(text_); }

 private:
  const ThrowStatistics& all() const { return table_.rows.back().statistics; }

  std::string heading(Role role) const {
    return role == Role::kNone ? "none: would have hit" : all().by(role).pilot;
  }

  // `values`: of kKeys.
  std::string cell(std::vector<std::string> values, Role role) const {
    values.resize(table_.keys.size(), "all");
    const StatisticsTable::Row* const row = find_row(table_, values);
    const Tally tally = row == nullptr ? Tally{} : row->statistics.by(role).tally;
    return tally_text(tally, role);
  }

  void size_rows(const std::string& size, const std::vector<std::string>& distances) {
    for (const Role role : pilots_) {
      text_ += "| " + size + (size == "all" ? "" : " m") + " | " + heading(role) + " |";
      for (const std::string& distance : distances) {
        text_ += " " + cell({size, distance, "all"}, role) + " |";
      }
      text_ += " " + cell({size, "all", "all"}, role) + " |\n";
    }
  }

  // The first throws of a cause.
  std::string numbers(const std::string& cause) const {
    constexpr int kMost = 12;
    std::string text;
    int count = 0;
    for (const ThrowResult* result : part_.results) {
      if (result->cause != cause || ++count > kMost) continue;
      text += (text.empty() ? "" : ", ") + std::to_string(result->index);
    }
    return count > kMost ? text + ", ..." : text;
  }

  const Part& part_;
  const TableAxes& axes_;
  const StatisticsTable& table_;
  std::vector<Role> pilots_;  // those with a column
  std::string text_;
};

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
  int after_room = 0;
  Rate quiet;
  for (const ThrowResult* result : part.results) {
    after_room += result->none_after_room ? 1 : 0;
    if (!result->flown.ok()) continue;
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

std::string markdown_of(const Part& part, const TableAxes& axes, const StatisticsTable& table) {
  std::string head;
  if (!part.values.empty()) head += "# " + label(part.values) + "\n\n";
  MarkdownWriter writer(part, axes, table);
  const bool anything_thrown = std::any_of(part.results.begin(), part.results.end(),
                                           [](const ThrowResult* r) { return r->thrown(); });
  if (anything_thrown) {
    const Tally& all = table.rows.back().statistics.flown().tally;
    head += "Dodged: " + rate_text(all.success()) + "\n\n";
    writer.by_size_and_distance();
    writer.by_speed();
    writer.perception();
  }
  writer.by_cell();
  writer.causes();
  return head + writer.take() + asides(part);
}

}  // namespace

Tables make_tables(const LoadedCampaign& campaign) {
  const std::vector<ThrowResult>& results = campaign.results;
  Tables tables;
  const bool thrown = std::ranges::any_of(results, &ThrowResult::thrown);
  tables.markdown =
      "# " + markdown_escaped(campaign.scenario.name) + "\n\n" +
      count_text(static_cast<std::int64_t>(results.size()), thrown ? "throw" : "flight") + ", " +
      pilots_of(campaign.scenario) + ".";
  if (thrown) {
    tables.markdown +=
        " Cells: dodged / would have hit (rate, 95 % Wilson interval); for the "
        "pilot none: would have hit / throws.";
  }
  tables.markdown += "\n\n";
  const int planned = throw_count(campaign.scenario);
  if (static_cast<int>(results.size()) < planned && !campaign.ended_early()) {
    tables.markdown += "Not all of the scenario's " + std::to_string(planned) +
                       ": a shard, or a campaign that was stopped.\n\n";
  }
  if (campaign.stop) tables.markdown += campaign.stop->text() + "\n\n";
  const TableAxes axes = {Axis("size_m", results), Axis("distance_m", results),
                          Axis("speed_mps", results), grid_axes(results)};
  StatisticsTable all;
  for (const Part& part : parts_of(campaign)) {
    const StatisticsTable table = all_cells(part, axes);
    tables.markdown += markdown_of(part, axes, table);
    StatisticsTable swept = of_sweep(part, table);
    all.keys = swept.keys;
    std::move(swept.rows.begin(), swept.rows.end(), std::back_inserter(all.rows));
  }
  tables.csv = to_csv(all);
  return tables;
}

}  // namespace dodgesim
