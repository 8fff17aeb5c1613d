#include "sim/gate/outcomes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/input_file.h"
#include "sim/base/numbers.h"
#include "sim/campaign/campaign_files.h"
#include "sim/files/json.h"
#include "sim/outcome/fate.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

// The same in throws.csv, where they are the first object's, and objects.csv.
constexpr const char* kDrawnNumbers[] = {"size_m",          "speed_mps",      "distance_m",
                                         "bearing_deg",     "aim_offset_m_0", "aim_offset_m_1",
                                         "spin_radps_0",    "spin_radps_1",   "spin_radps_2",
                                         "launch_height_m", "launch_us"};

std::string label_of(const CsvTable& throws, std::size_t row) {
  const std::string& object = throws.at(row, "object");
  if (object.empty()) return "quiet flight";
  return formatted("%.3g m %s, %.3g m/s from %.3g m", throws.number(row, "size_m"), object.c_str(),
                   throws.number(row, "speed_mps"), throws.number(row, "distance_m"));
}

DrawnObject drawn(const CsvTable& table, std::size_t row, const char* kind_column) {
  DrawnObject object{table.at(row, kind_column), {}};
  for (const char* column : kDrawnNumbers) object.numbers.push_back(table.number(row, column));
  return object;
}

// The columns of the grid's and the sweep's keys stand behind those of their numbers.
std::vector<AxisValue> settings_of(const CsvTable& throws, std::size_t row) {
  std::vector<AxisValue> settings;
  const auto& columns = throws.columns();
  const auto end = std::ranges::find(columns, "objects");
  auto column = std::find(columns.begin(), end, "sweep");
  if (column == end) return settings;
  for (++column; column != end; ++column) {
    settings.push_back({*column, with_one_spelling(throws.at(row, *column))});
  }
  return settings;
}

// Reads the objects of one throw after the other.
class Draws {
 public:
  explicit Draws(const CampaignTables& campaign) : campaign_(campaign) {}

  std::vector<DrawnObject> of_throw(std::size_t row, int number) {
    const CsvTable& throws = campaign_.throws;
    const int count = throws.integer(row, "objects");
    if (count == 0) return {};
    if (count == 1) return {drawn(throws, row, "object")};
    std::vector<DrawnObject> draw;
    while (next_is_of(number)) draw.push_back(drawn(*campaign_.objects, next_++, "kind"));
    if (static_cast<int>(draw.size()) == count) return draw;
    throw IoError(throws.name() + ": throw " + std::to_string(number) + " has " +
                  std::to_string(count) + " objects, but objects.csv beside it has " +
                  std::to_string(draw.size()) + " of them.");
  }

 private:
  bool next_is_of(int number) {
    if (!campaign_.objects) return false;
    const CsvTable& objects = *campaign_.objects;
    while (next_ < objects.rows() && objects.integer(next_, "throw") < number) ++next_;
    return next_ < objects.rows() && objects.integer(next_, "throw") == number;
  }

  const CampaignTables& campaign_;
  std::size_t next_ = 0;  // row of objects.csv
};

std::optional<TimeUs> time_at(const CsvTable& table, std::size_t row, const std::string& column) {
  if (table.at(row, column).empty()) return std::nullopt;
  return std::llround(table.number(row, column));
}

FlightResult flight_of(const CsvTable& table, std::size_t row, const std::string& pilot) {
  FlightResult flight;
  flight.status = table.one_of(row, pilot + "_status", {"ok", "error", "lost", "not flown"});
  flight.error = table.at(row, pilot + "_error");
  flight.hit = table.boolean(row, pilot + "_hit");
  flight.crashed = table.boolean(row, pilot + "_crashed");
  return flight;
}

// As far as it says what became of the throw.
ThrowResult result_of(const CsvTable& table, std::size_t row) {
  ThrowResult result;
  result.object = table.at(row, "object");
  result.flown = flight_of(table, row, "flown");
  result.none = flight_of(table, row, "none");
  result.oracle = flight_of(table, row, "oracle");
  result.evaded = table.boolean(row, "evaded");
  result.landing_us = time_at(table, row, "landing_us");
  result.none.hit_us = time_at(table, row, "none_hit_us");
  return result;
}

// ThrowOutcome::what. Whether a throw would have hit is told by `counts`.
std::string what_of(const ThrowResult& result) {
  switch (const Fate fate = fate_of(result)) {
    case Fate::kNotFlown:
    case Fate::kFailed:
      return "error: " + result.flown.error;
    case Fate::kFalseAlarm:
      return "evaded nothing";
    case Fate::kNotJudged:
      return "not judged: " + result.none.error;
    case Fate::kWouldHaveMissed:
      return to_text(Fate::kDodged);
    default:
      return to_text(fate);
  }
}

void judge(const ThrowResult& result, ThrowOutcome& out) {
  const Fate fate = fate_of(result);
  out.failed = result.flown.failed() || result.none.failed();
  out.nobody_could_fly = fate == Fate::kNotFlown;
  const bool would_have_missed = result.none.ok() && !result.none.hit;
  out.counts = !out.nobody_could_fly && (!result.thrown() || !would_have_missed);
  out.success = fate == Fate::kDodged || fate == Fate::kWouldHaveMissed || fate == Fate::kQuiet;
  out.what = what_of(result);
}

bool same_number(double a, double b) {
  constexpr double kTolerance = 1e-9;
  return std::abs(a - b) <= kTolerance * std::max({1.0, std::abs(a), std::abs(b)});
}

// How many throws a value of the sweep has. A table without its manifest is taken for whole: the
// first throw of sweep value 1 tells.
std::int64_t throws_per_sweep_value(const CampaignTables& campaign) {
  constexpr std::uint64_t kMost = std::numeric_limits<int>::max();
  const std::uint64_t planned = campaign.planned.value_or(0);
  const std::uint64_t values = campaign.sweep_values.value_or(0);
  if (planned > 0 && planned <= kMost && values > 0) {
    return static_cast<std::int64_t>(planned / values);
  }
  const CsvTable& throws = campaign.throws;
  for (std::size_t row = 0; row < throws.rows(); ++row) {
    const int sweep = throws.integer(row, "sweep");
    if (sweep > 0) return throws.integer(row, "throw") / sweep;
  }
  return 0;
}

bool same_seed(const ThrowOutcome& a, const ThrowOutcome& b) {
  return !a.seed || !b.seed || *a.seed == *b.seed;
}

// What the manifest says of the campaign; null: nothing.
Json find_in(const Json& manifest, const char* key) {
  const auto group = manifest.find("campaign");
  if (group == manifest.end() || !group->is_object()) return Json();
  const auto value = group->find(key);
  return value == group->end() ? Json() : *value;
}

std::optional<std::uint64_t> find_number(const Json& manifest, const char* key) {
  const Json number = find_in(manifest, key);
  if (!number.is_number_unsigned()) return std::nullopt;
  return number.get<std::uint64_t>();
}

Json manifest_or_nothing(const fs::path& path) {
  try {
    return parse_json(read_file(path));
  } catch (const std::invalid_argument&) {
    return Json();
  }
}

}  // namespace

CampaignTables read_tables(const fs::path& directory) {
  const fs::path throws = directory / kThrowsFile;
  refuse_file(directory);
  if (!fs::exists(throws) && fs::exists(directory / kJournalFile)) {
    throw MissingThrows(directory.string() +
                        " is not finished, so it has no throws.csv: the same run " +
                        "with --resume flies what is missing.");
  }
  if (!fs::exists(throws)) {
    throw IoError(throws.string() + " is missing; " + kWhatNamesACampaign + ".");
  }
  CampaignTables tables{CsvTable(throws)};
  const fs::path objects = directory / kObjectsFile;
  if (fs::exists(objects)) tables.objects.emplace(objects);
  const fs::path path = directory / kManifestFile;
  if (!fs::exists(path)) return tables;
  const Json manifest = manifest_or_nothing(path);
  tables.seed = find_number(manifest, "seed");
  tables.planned = find_number(manifest, "throws");
  tables.sweep_values = find_number(manifest, "sweep_values");
  const Json models = find_in(manifest, "models");
  if (models.is_string()) tables.models = models;
  return tables;
}

bool is_drawn(const std::string& column) {
  return column == "object" || column == "kind" || column == "objects" ||
         contains(kDrawnNumbers, column);
}

std::vector<ThrowOutcome> outcomes(const CampaignTables& campaign) {
  const CsvTable& throws = campaign.throws;
  Draws draws(campaign);
  const std::int64_t per_sweep_value = throws_per_sweep_value(campaign);
  std::vector<ThrowOutcome> all;
  for (std::size_t row = 0; row < throws.rows(); ++row) {
    ThrowOutcome out;
    out.number = throws.integer(row, "throw");
    if (!all.empty() && out.number <= all.back().number) {
      throw IoError(throws.name() + ": throw " + std::to_string(out.number) +
                    " stands behind throw " + std::to_string(all.back().number) + ".");
    }
    out.cell = throws.integer(row, "cell");
    out.sweep = throws.integer(row, "sweep");
    out.stream = out.number - out.sweep * per_sweep_value;
    out.settings = settings_of(throws, row);
    out.label = label_of(throws, row);
    out.draw = draws.of_throw(row, out.number);
    out.seed = campaign.seed;
    judge(result_of(throws, row), out);
    all.push_back(std::move(out));
  }
  return all;
}

std::vector<std::string> differing_draws(const ThrowOutcome& a, const ThrowOutcome& b) {
  if (a.draw.size() != b.draw.size()) return {"number of objects"};
  std::set<std::size_t> differing;  // columns of kDrawnNumbers
  bool other_kind = false;
  for (std::size_t i = 0; i < a.draw.size(); ++i) {
    other_kind = other_kind || a.draw[i].kind != b.draw[i].kind;
    for (std::size_t k = 0; k < std::size(kDrawnNumbers); ++k) {
      if (!same_number(a.draw[i].numbers[k], b.draw[i].numbers[k])) differing.insert(k);
    }
  }
  std::vector<std::string> names;
  if (other_kind) names.emplace_back("object");
  for (const std::size_t k : differing) names.emplace_back(kDrawnNumbers[k]);
  return names;
}

bool same_throw(const ThrowOutcome& a, const ThrowOutcome& b) {
  return same_seed(a, b) && differing_draws(a, b).empty();
}

bool same_random_numbers(const ThrowOutcome& a, const ThrowOutcome& b) {
  if (a.cell != b.cell) return false;
  return a.seed && b.seed ? *a.seed == *b.seed : differing_draws(a, b).empty();
}

}  // namespace dodgesim
