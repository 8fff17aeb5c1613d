// Table 2: how often a visible object is detected.
#include <array>
#include <limits>
#include <map>
#include <tuple>

#include "sim/base/error.h"
#include "sim/config/expand.h"
#include "sim/files/text_table.h"
#include "sim/paper/experiment.h"
#include "sim/paper/miss_investigator.h"
#include "sim/paper/success.h"
#include "sim/statistics/interval.h"

namespace dodgesim {

namespace {

constexpr std::size_t kSizes = 3, kRanges = 3;  // cells of the scenario's grid; columns
constexpr const char* kSizeNames[kSizes] = {"<= 0.1 m", "<= 0.2 m", "<= 0.3 m"};
constexpr const char* kRangeNames[kRanges] = {"<= 0.5 m", "<= 1 m", "<= 1.5 m"};
constexpr double kPublished[kSizes][kRanges] = {
    {0.92, 0.90, 0.88}, {0.87, 0.92, 0.97}, {0.81, 0.88, 0.93}};

constexpr std::array<RangeBin, kRanges> kDistanceBins = {{{0, 0.5}, {0.5, 1}, {1, 1.5}}};
constexpr std::array<RangeBin, kRanges> kNested = {{{0, 0.5}, {0, 1}, {0, 1.5}}};

// A detection speaks of the mean time of its events, some 3 ms before the end of its window.
constexpr TimeUs kDetectionAgeUs = 3000;

struct Reading {
  const char* name;
  std::array<RangeBin, kRanges> ranges;
  Visibility visibility;
};

// The first is the one that is compared with the paper.
constexpr std::array<Reading, 3> kReadings = {{
    {"bins of distance, centre in view", kDistanceBins, Visibility::kCentre},
    {"nested distances, centre in view", kNested, Visibility::kCentre},
    {"bins of distance, wholly in view", kDistanceBins, Visibility::kWhole},
}};

constexpr const char* kTable2Protocol = R"(How the protocol is read:

- *Throws through the field of view*: 100 balls of each category pass a hovering vehicle at 0.4 to
  0.7 m, at 3 to 10 m/s, from the left to the right. It perceives but never evades (`k_r0: 0`).
- *Size*: the categories are 5 to 10, 10 to 20 and 20 to 30 cm, drawn uniformly.
- *Distance*: true, from the top camera to the ball's centre, in bins from one column's limit to the
  next. With nested ranges, as "<=" alone would mean, a detection at 0.4 m would count in all three
  columns, and small balls would hardly do worse in the last one "because of the limited angular
  resolution". The second table has them nevertheless.
- *In the field of view of the cameras*: the ball's centre is in the image of both cameras, by truth
  and calibration, for at least 10 ms in all while its distance is in the bin: as long as one window
  of events.
- *The system did not report any detection*: none of the ball at an instant at which it was in view
  and in the bin. A detection is of the ball when it lies in a direction within its outline or at most
  3 degrees (10 px) beyond.
- *Failure*: one passage of a bin is one trial. The fourth table counts every 10 ms in view as a
  trial of its own instead, which is a stricter detector's test than the paper describes.
- *How far the pilot got at best*: of a missed passage or piece, over the pilot's cycles while the
  ball was in view; the throws were flown again for this, with a look at events, clusters and
  matches.
- Intervals: 95 %, Wilson. Pieces of one passage may be seen or missed together: passages of m
  pieces each count as (sum m)^2 / sum m^2 trials, at most as many as there are passages, with the
  same share detected. A cell is below the paper when its interval is.
)";

// Detected and visible.
struct Cell {
  std::int64_t detected = 0, visible = 0;
  Interval interval;

  std::string text() const {
    std::string text = std::to_string(detected) + " / " + std::to_string(visible);
    if (visible == 0) return text;
    return text + " (" + fixed_text(rate(), 3) + ", " + fixed_text(interval.lo, 3) + " to " +
           fixed_text(interval.hi, 3) + ")";
  }
  double rate() const { return static_cast<double>(detected) / static_cast<double>(visible); }
};

using Cells = std::array<std::array<Cell, kRanges>, kSizes>;

bool below(const Cells& cells, std::size_t size, std::size_t range) {
  return cells[size][range].interval.hi < kPublished[size][range];
}

// One ball and one column of a reading.
struct PassageCase {
  std::size_t size = 0, range = 0;
  TimeInView in_view;
  const ThrowResult* result = nullptr;
};

// Those in which the ball was in view.
std::vector<PassageCase> passages(const LoadedCampaign& campaign, const Reading& reading) {
  const CameraRig rig = camera_rig(campaign.scenario);
  std::vector<PassageCase> cases;
  for (const ThrowResult& result : campaign.results) {
    if (!result.flown.ok() || result.trajectory.empty()) continue;
    const Passage passage(trajectory_from_bytes(result.trajectory), rig);
    for (std::size_t range = 0; range < kRanges; ++range) {
      const TimeInView seen =
          time_in_view(passage, result.detection_rows, reading.ranges[range], reading.visibility);
      if (seen.counts()) {
        cases.push_back({static_cast<std::size_t>(result.cell), range, seen, &result});
      }
    }
  }
  return cases;
}

Cells count_passages(const std::vector<PassageCase>& cases) {
  Cells cells;
  for (const PassageCase& passage : cases) {
    Cell& cell = cells.at(passage.size)[passage.range];
    ++cell.visible;
    cell.detected += passage.in_view.detected() ? 1 : 0;
    cell.interval = wilson(cell.detected, cell.visible);
  }
  return cells;
}

// Of the pieces of the passages of one cell.
Cell count_pieces(const std::vector<TimeInView>& passages) {
  Cell cell;
  std::vector<std::int64_t> pieces;
  for (const TimeInView& passage : passages) {
    pieces.push_back(passage.pieces);
    cell.visible += passage.pieces;
    cell.detected += passage.detected_pieces();
  }
  if (!passages.empty()) cell.interval = wilson_of_clusters(cell.rate(), pieces);
  return cell;
}

Cells count_pieces(const std::vector<PassageCase>& cases) {
  std::array<std::array<std::vector<TimeInView>, kRanges>, kSizes> times;
  for (const PassageCase& passage : cases) {
    if (passage.in_view.pieces == 0) continue;
    times.at(passage.size)[passage.range].push_back(passage.in_view);
  }
  Cells cells;
  for (std::size_t size = 0; size < kSizes; ++size) {
    for (std::size_t range = 0; range < kRanges; ++range) {
      cells[size][range] = count_pieces(times[size][range]);
    }
  }
  return cells;
}

std::string cells_markdown(const Cells& cells) {
  TextTable table;
  table.head = {"size"};
  for (const char* range : kRangeNames) table.head.insert(table.head.end(), {range, "paper"});
  for (std::size_t size = 0; size < kSizes; ++size) {
    auto& row = table.rows.emplace_back();
    row.push_back(kSizeNames[size]);
    for (std::size_t range = 0; range < kRanges; ++range) {
      const char* mark = below(cells, size, range) ? " **below**" : "";
      row.push_back(cells[size][range].text() + mark);
      row.push_back(fixed_text(kPublished[size][range], 2));
    }
  }
  return table.to_markdown() + "\n";
}

void add_to_csv(const std::string& reading, const Cells& cells, TextTable& csv) {
  for (std::size_t size = 0; size < kSizes; ++size) {
    for (std::size_t range = 0; range < kRanges; ++range) {
      const Cell& cell = cells[size][range];
      csv.rows.push_back(
          {reading, kSizeNames[size], kRangeNames[range], std::to_string(cell.detected),
           std::to_string(cell.visible), cell.visible > 0 ? fixed_text(cell.rate(), 4) : "",
           fixed_text(cell.interval.lo, 4), fixed_text(cell.interval.hi, 4),
           fixed_text(kPublished[size][range], 2), below(cells, size, range) ? "1" : "0"});
    }
  }
}

// A row for each cell and reason.
std::string reasons_markdown(const std::vector<PassageCase>& cases,
                             MissInvestigator& investigator) {
  std::map<std::tuple<std::size_t, std::size_t, Miss>, std::array<int, 2>> counts;
  for (const PassageCase& passage : cases) {
    const auto reason = [&](TimeUs from_us, TimeUs to_us) {
      const Miss miss =
          investigator.reason(passage.result->index, kDistanceBins[passage.range], from_us, to_us);
      return std::tuple(passage.size, passage.range, miss);
    };
    if (!passage.in_view.detected()) {
      ++counts[reason(0, std::numeric_limits<TimeUs>::max())][0];
    }
    for (const TimeUs begin_us : passage.in_view.missed_us) {
      const TimeUs from_us = begin_us + kDetectionAgeUs;
      ++counts[reason(from_us, from_us + kLeastVisibleUs)][1];
    }
  }
  if (counts.empty()) return "Nothing was missed.\n\n";
  TextTable table;
  table.head = {"size", "distance", "how far the pilot got at best", "passages", "pieces of 10 ms"};
  for (const auto& [key, count] : counts) {
    const auto& [size, range, miss] = key;
    table.rows.push_back({kSizeNames[size], kRangeNames[range], miss_text(miss),
                          std::to_string(count[0]), std::to_string(count[1])});
  }
  return table.to_markdown() + "\n";
}

// The passages that were missed, for replay.
std::string misses_markdown(const std::vector<PassageCase>& cases) {
  TextTable table;
  table.head = {"size", "distance", "throw", "ball (m)", "speed (m/s)", "in view (ms)"};
  for (const PassageCase& passage : cases) {
    if (passage.in_view.detected()) continue;
    table.rows.push_back({kSizeNames[passage.size], kRangeNames[passage.range],
                          std::to_string(passage.result->index),
                          fixed_text(passage.result->size_m, 3),
                          fixed_text(passage.result->speed_mps, 1),
                          std::to_string(passage.in_view.visible_us / 1000)});
  }
  return table.rows.empty() ? "" : "Missed passages:\n\n" + table.to_markdown() + "\n";
}

PaperTables analyse_table2(const std::vector<LoadedCampaign>& campaigns) {
  const LoadedCampaign& campaign = campaigns.front();
  if (cell_count(campaign.scenario) != static_cast<int>(kSizes)) {
    throw ScenarioError("Table 2 needs a grid of three cells, one for each category of sizes.");
  }
  PaperTables tables;
  TextTable csv;
  csv.head = {"reading", "size", "distance", "detected", "visible",
              "rate",    "lo",   "hi",       "paper",    "below"};
  const auto add = [&](const std::string& name, const Cells& cells) {
    tables.markdown += "### " + name + "\n\n" + cells_markdown(cells);
    add_to_csv(name, cells, csv);
  };
  tables.markdown = "Detected / visible (rate, 95 % interval).\n\n";
  const std::vector<PassageCase> cases = passages(campaign, kReadings.front());
  add(kReadings.front().name, count_passages(cases));
  for (std::size_t i = 1; i < kReadings.size(); ++i) {
    add(kReadings[i].name, count_passages(passages(campaign, kReadings[i])));
  }
  add("bins of distance, centre in view, each 10 ms by itself", count_pieces(cases));

  MissInvestigator investigator(campaign);
  tables.markdown += "### Misses of the first and of the fourth table\n\n" +
                     reasons_markdown(cases, investigator) + misses_markdown(cases);
  tables.markdown += kTable2Protocol;
  tables.csv = csv.to_csv();
  return tables;
}

}  // namespace

PaperExperiment table2_experiment() {
  return {"table2",
          "Table 2: success rate of the detector",
          {{"passing", "passing.yaml", {}}},
          analyse_table2};
}

}  // namespace dodgesim
